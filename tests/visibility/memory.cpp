// SPDX-License-Identifier: MIT
/// What calls about visibility allocate: no more than they may, and nothing that is left where an allocation fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "failing_memory.hpp"
#include "many/workload.hpp"
#include "oracle/random.hpp"
#include "oracle/sight_scene.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

/// Two sides of a gap full of blockers: all pairs are undecided, with most of the blockers as candidates.
struct Gap {
  PatchSet left;
  PatchSet right;
  Blockers blockers;

  Gap(std::size_t patches, std::size_t between) {
    Random random(5);
    std::vector<Box> boxes[2];
    for (std::size_t i = 0; i != 2 * patches; ++i) {
      Box box = random.box(-1, 1, 0.5F, 0.6F);
      box.lo[0] = box.hi[0] = i % 2 == 0 ? -3.0F : 3.0F;
      boxes[i % 2].push_back(box);
    }
    left = PatchSet(std::span<const Box>(boxes[0]));
    right = PatchSet(std::span<const Box>(boxes[1]));
    std::vector<Box> all;
    for (std::size_t i = 0; i != between; ++i) all.push_back(random.box(-0.8F, 0.8F, 0.2F, 0.7F));
    blockers.add_boxes(std::span<const Box>(all));
  }
};

TEST(VisibilityMemory, StaysBelowItsBoundHoweverManyPairsAreUndecided) {
  const Gap gap(has_shadow_memory ? 300 : 1200, 60);
  for (const int threads : {1, 2}) {
    for (const std::size_t memory : {std::size_t{1} << 20, std::size_t{8} << 20}) {
      VisibilityOptions options;
      options.memory = memory;
      std::uint64_t candidates = 0;
      std::uint64_t pairs = 0;
      std::size_t largest = 0;
      std::size_t peak = 0;
      with_threads(threads, [&] {
        const std::size_t before = live_bytes();
        forget_peak();
        visibility(
            gap.left, gap.right, gap.blockers,
            [&](const SightBatch& batch) {
              pairs += batch.undecided.pairs.size();
              candidates += batch.undecided.candidates.size();
              largest = std::max(largest, batch.undecided.candidates.size_bytes());
            },
            options);
        peak = peak_bytes() - before;
      });
      ASSERT_GT(pairs, gap.left.size() * gap.right.size() / 2);
      ASSERT_GT(candidates, 20 * pairs);  // far more than the bound
      EXPECT_LE(peak, memory) << threads << " threads, " << memory << " bytes, batches of up to " << largest;
      EXPECT_LE(largest, memory);
    }
  }
}

/// Fails each allocation of a call in turn, and expects std::bad_alloc and nothing left behind.
template <class Call>
void expect_nothing_left(const Call& call) {
  call();  // what is made once only
  for (const Failing failing : {Failing::only_one, Failing::from_then_on}) {
    std::size_t thrown = 0;
    for (std::size_t n = 1;; ++n) {
      const std::size_t before = live_bytes();
      bool was_thrown = false;
      bool has_failed = false;
      {
        const FailingMemory memory(n, failing);
        try {
          call();
        } catch (const std::bad_alloc&) {
          was_thrown = true;
        }
        has_failed = memory.has_failed();
      }
      const std::size_t after = live_bytes();
      // A call may do without what it did not get: std::stable_partition() does.
      EXPECT_TRUE(has_failed || !was_thrown) << "allocation " << n;
      thrown += was_thrown ? 1 : 0;
      EXPECT_EQ(after, before) << "allocation " << n;
      if (!has_failed) {
        EXPECT_GT(thrown, (n - 1) / 2);
        break;
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(VisibilityMemory, ThatRunsOutLeavesNothingBehind) {
  SightScene scene;
  for (std::uint64_t seed = 1;; ++seed) {
    scene = random_sight_scene(SightScenery::room, seed, 150);
    if (!scene.is_of_one_set && scene.a.size() > 70 && scene.b.size() > 70 && !scene.solids.empty() &&
        scene.triangles.size() > 3 && scene.first_hull.size() > 1) {
      break;
    }
  }
  const PatchSet a = first_set(scene);
  const PatchSet b = second_set(scene);
  const Blockers blockers = blockers_of(scene);
  VisibilityOptions options;
  with_threads(1, [&] {
    expect_nothing_left([&] { static_cast<void>(first_set(scene)); });
    expect_nothing_left([&] { static_cast<void>(blockers_of(scene)); });
    expect_nothing_left([&] { static_cast<void>(merged_boxes(scene.solids)); });
    expect_nothing_left([&] { static_cast<void>(count_visibility(a, b, blockers, options)); });
    expect_nothing_left([&] { static_cast<void>(count_visibility(a, blockers, options)); });
    expect_nothing_left([&] { static_cast<void>(collect_visibility(a, b, blockers, options)); });
    options.resolve = [](const UndecidedPairs&, std::span<Sight> verdict) {
      for (std::size_t i = 0; i < verdict.size(); i += 2) verdict[i] = Sight::blocked;
    };
    expect_nothing_left([&] { static_cast<void>(collect_visibility(a, b, blockers, options)); });
  });
}

TEST(VisibilityMemory, BlockersAreWhatTheyWereWhereMemoryRunsOut) {
  const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}};
  for (std::size_t n = 1;; ++n) {
    Blockers blockers;
    blockers.add_solids(std::span<const Box>(boxes));
    bool has_failed = false;
    {
      const FailingMemory memory(n, Failing::only_one);
      try {
        blockers.add_solids(std::span<const Box>(boxes));
      } catch (const std::bad_alloc&) {
        EXPECT_EQ(blockers.size(), 2U);
      }
      has_failed = memory.has_failed();
    }
    EXPECT_EQ(blockers.box(1), boxes[1]);
    if (!has_failed) break;
    blockers.add_solids(std::span<const Box>(boxes));
    EXPECT_EQ(blockers.size(), 4U);
  }
}

}  // namespace
}  // namespace shaftcull
