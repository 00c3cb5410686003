// SPDX-License-Identifier: MIT
/// What building large trees allocates, and the order of one, which is on record.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "failing_memory.hpp"
#include "many/workload.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"
#include "support/float_environment.hpp"
#include "tree/build.hpp"
#include "tree/scenes.hpp"
#include "tree/source.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

using kernel::RegionSizes;

/// Bounds of a tree that is built by regions; a power of two, so that its streams are apart.
constexpr std::size_t large = std::size_t{1} << 22U;
static_assert(large >= RegionSizes().fewest_bounds);

/// Bounds with many equal centres, some of them large, and one empty box.
template <class Bound>
std::vector<Bound> large_scene() {
  Random random(920);
  std::vector<Bound> bounds(large);
  for (std::size_t i = 0; i != large; ++i) {
    const Vec3 centre{random.integer(-500, 500), random.uniform(-500, 500), random.integer(-100, 100)};
    const float half = i % 1000 == 0 ? 20.0F : 1.0F;
    if constexpr (std::is_same_v<Bound, Box>) {
      for (std::size_t k = 0; k != 3; ++k) {
        bounds[i].lo[k] = centre[k] - half;
        bounds[i].hi[k] = centre[k] + half;
      }
    } else {
      bounds[i] = {centre, half};
    }
  }
  if constexpr (std::is_same_v<Bound, Box>) bounds[4711] = empty_box;
  return bounds;
}

std::uint64_t checksum(std::span<const std::uint32_t> order) {
  std::uint64_t sum = 1;
  for (const std::uint32_t i : order) sum = (sum ^ i) * 0x100000001b3U + (sum >> 29U);
  return sum;
}

template <class Tree>
class LargeTree : public testing::Test {};
TYPED_TEST_SUITE(LargeTree, TreeKinds);

TYPED_TEST(LargeTree, KeepsItsOrderAndTheBoundOfItsMemory) {
  using Bound = BoundOf<TypeParam>;
  if (has_shadow_memory) GTEST_SKIP() << "too many bounds for a sanitizer";
  const std::vector<Bound> bounds = large_scene<Bound>();
  const std::uint64_t on_record = std::is_same_v<Bound, Box> ? 10653367051374945110U : 9591559907332622002U;
  for (const int threads : {1, 2}) {
    std::size_t peak = 0;
    std::size_t of_tree = 0;
    with_threads(threads, [&] {
      const std::size_t before = live_bytes();
      forget_peak();
      const TypeParam tree{std::span<const Bound>(bounds)};
      peak = peak_bytes() - before;
      of_tree = tree.memory_bytes();
      EXPECT_EQ(checksum(tree.order()), on_record);
    });
    const std::size_t scratch = std::is_same_v<Bound, Box> ? 8 : 12;
    EXPECT_GE(peak, of_tree);  // something is counted
    EXPECT_LE(peak, of_tree + scratch * large + (std::size_t{1} << 20U) * static_cast<std::size_t>(threads));
    if (std::is_same_v<TypeParam, BoxTree>) {
      EXPECT_LE(peak, 40 * large);
    }
  }
}

TYPED_TEST(LargeTree, LeavesNothingBehindIfMemoryRunsOut) {
  using Bound = BoundOf<TypeParam>;
  Random random(921);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::clustered, 9000);
  const kernel::RecordSource<Bound> source(strided(std::span<const Bound>(bounds)));
  const auto call = [&] {
    return kernel::in_float_environment([&] { return kernel::build<Bound>(source, RegionSizes{1, 4096, 4096}).order; });
  };
  const kernel::TreeArray<std::uint32_t> order = call();
  for (const Failing failing : {Failing::only_one, Failing::from_then_on}) {
    for (std::size_t n = 1;; ++n) {
      const std::size_t before = live_bytes();
      const auto [was_thrown, has_failed] = call_with_failing(n, failing, call);
      EXPECT_EQ(was_thrown, has_failed) << "allocation " << n;
      EXPECT_EQ(live_bytes(), before) << "allocation " << n;
      if (!has_failed || testing::Test::HasFailure()) break;
    }
  }
  EXPECT_EQ(call(), order);
}

}  // namespace
}  // namespace shaftcull
