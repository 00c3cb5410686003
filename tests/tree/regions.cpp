// SPDX-License-Identifier: MIT
/// Trees built region by region: they are those that are built at once, bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "caught.hpp"
#include "many/workload.hpp"
#include "oracle/random.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"
#include "support/float_environment.hpp"
#include "tree/build.hpp"
#include "tree/scenes.hpp"
#include "tree/source.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

using kernel::RegionSizes;

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

/// Sizes that build as small trees are built, and by regions: of nearly whole words of nodes, and of few words.
constexpr RegionSizes at_once{never, never, never};
constexpr RegionSizes by_regions[] = {{1, 4096, 4096}, {1, 700, 64}, {1, never, never}};

template <class View>
bool are_same_bits(const View& a, const View& b) {
  if (a.count != b.count) return false;
  for (std::size_t s = 0; a.count != 0 && s != a.stream.size(); ++s) {
    if (std::memcmp(a.stream[s], b.stream[s], bit_words(a.count) * 64 * sizeof(float)) != 0) return false;
  }
  return true;
}

template <class Bound>
void expect_same(const kernel::TreeParts<Bound>& a, const kernel::TreeParts<Bound>& b) {
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.least_index, b.least_index);
  EXPECT_TRUE(are_same_bits(a.leaves.view(), b.leaves.view()));
  EXPECT_TRUE(are_same_bits(a.nodes.view(), b.nodes.view()));
  EXPECT_EQ(a.gaps, b.gaps);
  EXPECT_EQ(a.surface_when_built, b.surface_when_built);
  EXPECT_EQ(a.layers.leaves, b.layers.leaves);
}

template <class Bound, class Source>
kernel::TreeParts<Bound> built(const Source& source, const RegionSizes& sizes) {
  return kernel::in_float_environment([&] { return kernel::build<Bound>(source, sizes); });
}

template <class Bound, class Source>
void expect_same_trees(const Source& source) {
  const auto tree = built<Bound>(source, at_once);
  for (const RegionSizes& sizes : by_regions) {
    SCOPED_TRACE(sizes.most_in_region);
    expect_same(tree, built<Bound>(source, sizes));
  }
}

template <class Tree>
class TreeRegions : public testing::Test {};
TYPED_TEST_SUITE(TreeRegions, TreeKinds);

TYPED_TEST(TreeRegions, TheTreeIsTheSameForAllScenes) {
  using Bound = BoundOf<TypeParam>;
  Random random(910);
  for (const Shape shape : shapes) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{64}, std::size_t{700}, std::size_t{4097},
                                    std::size_t{3 * 4096}, std::size_t{20011}}) {
      SCOPED_TRACE(text(shape));
      SCOPED_TRACE(count);
      const std::vector<Bound> bounds = scene<Bound>(random, shape, count);
      expect_same_trees<Bound>(kernel::RecordSource<Bound>(strided(std::span<const Bound>(bounds))));
      const kernel::StreamOf<ViewOf<Bound>> stream{std::span<const Bound>(bounds)};
      expect_same_trees<Bound>(kernel::ViewSource<Bound>(stream.view()));
    }
  }
}

TYPED_TEST(TreeRegions, TheTreeIsTheSameForAnyNumberOfThreads) {
#ifdef __wasi__
  GTEST_SKIP() << "WebAssembly has one thread; and after this test, Node.js 20 crashes when the program has ended";
#endif
  using Bound = BoundOf<TypeParam>;
  Random random(911);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::wild_sizes, 200000);
  const kernel::RecordSource<Bound> source(strided(std::span<const Bound>(bounds)));
  const auto tree = built<Bound>(source, at_once);
  for (const int threads : {1, 2, 3}) {
    with_threads(threads, [&] { expect_same(tree, built<Bound>(source, by_regions[0])); });
  }
}

TYPED_TEST(TreeRegions, RebuildingGivesTheSameTree) {
  using Bound = BoundOf<TypeParam>;
  Random random(912);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::clustered, 30000);
  auto tree = built<Bound>(kernel::RecordSource<Bound>(strided(std::span<const Bound>(bounds))), at_once);
  std::vector<std::uint32_t> layers;
  for (std::size_t i = 0; i != bounds.size(); ++i) layers.push_back(random.below(7));
  tree.layers = kernel::layers_of<Bound>(tree, tree.order, layers);
  kernel::in_float_environment([&] {
    for (const RegionSizes& sizes : by_regions) expect_same(tree, kernel::rebuild(tree, sizes));
  });
}

TEST(TreeRegionsOfCentres, HalfExtentsGiveTheSameTree) {
  Random random(913);
  for (const Shape shape : {Shape::uniform, Shape::wild_sizes, Shape::lattice}) {
    std::vector<Blob> blobs;
    for (std::size_t i = 0; i != 9000; ++i) blobs.push_back(blob(random, shape, i));
    const kernel::CentreExtentSource source({&blobs[0].centre, &blobs[0].half, sizeof(Blob), blobs.size()});
    expect_same_trees<Box>(source);
  }
}

TYPED_TEST(TreeRegions, TheFirstBadBoundIsNamed) {
  using Bound = BoundOf<TypeParam>;
  Random random(914);
  std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, 20000);
  for (const std::size_t i : {19000U, 17003U}) {
    std::memset(&bounds[i], 0xff, sizeof(Bound));  // NaN
  }
  const auto error = caught<BadBound>(
      [&] { built<Bound>(kernel::RecordSource<Bound>(strided(std::span<const Bound>(bounds))), by_regions[0]); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->index(), 17003U);
}

}  // namespace
}  // namespace shaftcull
