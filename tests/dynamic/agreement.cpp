// SPDX-License-Identifier: MIT
/// Dynamic trees answer as plain arrays that are given the same changes, whatever these are.
#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "caught.hpp"
#include "dynamic/world.hpp"
#include "float_modes.hpp"
#include "instruction_sets.hpp"
#include "many/workload.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

template <class Bound>
class DynamicTrees : public testing::Test {};
TYPED_TEST_SUITE(DynamicTrees, DynamicKinds);

TYPED_TEST(DynamicTrees, AnswerAsAnArrayDoesInEveryShape) {
  for (const Shape shape : shapes) {
    SCOPED_TRACE(text(shape));
    World<TypeParam> world(200 + static_cast<std::uint64_t>(shape));
    for (unsigned commit = 0; commit != random_cases(12); ++commit) {
      world.change({.shape = shape, .count = 1U << world.random().below(11), .layers = commit > 5});
      world.tree.commit();
      expect_equal(world.tree.committed(), world.model, world.random());
      if (testing::Test::HasFailure()) return;
    }
  }
}

// Of several blocks: those are sorted again, split, emptied, and made anew.
TYPED_TEST(DynamicTrees, AnswerAsAnArrayDoesWhereTheyHaveManyBlocks) {
  for (std::uint64_t seed = 1; seed <= random_cases(8); ++seed) {
    SCOPED_TRACE(seed);
    World<TypeParam> world(seed);
    world.change({.shape = Shape::wild_sizes, .count = 3000, .insertions = 10, .layers = seed % 2 == 0});
    world.tree.commit();
    for (unsigned commit = 0; commit != 12; ++commit) {
      const Shape shape = shapes[world.random().below(std::size(shapes))];
      const bool grows = commit < 7;
      world.change({shape, 2000U + world.random().below(4000), grows ? 8U : 1U, seed % 2 == 0});
      world.tree.commit();
      if (commit % 3 != 2) continue;
      expect_equal(world.tree.committed(), world.model, world.random());
      if (testing::Test::HasFailure()) return;
    }
  }
}

TYPED_TEST(DynamicTrees, SnapshotsStayAsTheyAre) {
  World<TypeParam> world(5);
  std::vector<std::pair<TreeSnapshot<TypeParam>, Model<TypeParam>>> before;
  for (unsigned commit = 0; commit != 24; ++commit) {
    world.change({.count = 400, .insertions = commit < 12 ? 7U : 3U, .layers = commit > 8});
    world.tree.commit();
    if (commit % 3 == 0) before.emplace_back(world.tree.snapshot(), world.model);
    if (commit % 7 == 6) before.erase(before.begin());
  }
  EXPECT_GT(before.size(), 3U);
  for (const auto& [snapshot, model] : before) expect_equal(snapshot, model, world.random());
  expect_equal(world.tree.committed(), world.model, world.random());
  world.tree = DynamicTree<TypeParam>();
  for (const auto& [snapshot, model] : before) expect_equal(snapshot, model, world.random());
}

/// A snapshot of a new world, with its model. The last state shares most blocks and pages with it.
template <class Bound>
std::pair<TreeSnapshot<Bound>, Model<Bound>> snapshot_that_shares_blocks(World<Bound>& world) {
  world.change({.count = 20000, .insertions = 10});
  world.tree.commit();
  std::pair<TreeSnapshot<Bound>, Model<Bound>> kept(world.tree.snapshot(), world.model);
  const BoundId some = world.model.ids.front();
  world.tree.move(some, world.tree[some]);
  world.tree.commit();
  return kept;
}

// A commit beside a snapshot leaves most blocks and pages to both. The next commits write where nobody else is.
TYPED_TEST(DynamicTrees, SnapshotsStayAsTheyAreWhereCommitsTouchFewBlocks) {
  World<TypeParam> world(15);
  const auto [snapshot, model] = snapshot_that_shares_blocks(world);
  for (unsigned commit = 0; commit != 12; ++commit) {
    world.change({.count = 4});
    world.tree.commit();
  }
  expect_equal(snapshot, model, world.random());
  expect_equal(world.tree.committed(), world.model, world.random());
}

// The same where the next commit sorts blocks again: too many bounds come to one place.
TYPED_TEST(DynamicTrees, SnapshotsStayAsTheyAreWhereCommitsSortBlocksAgain) {
  World<TypeParam> world(21);
  const auto [snapshot, model] = snapshot_that_shares_blocks(world);
  const TypeParam bound = model.bounds.front();
  for (unsigned i = 0; i != 4000; ++i) world.model.insert(world.tree.insert(bound), bound, all_layers);
  world.change({.count = 400, .insertions = 0});
  world.tree.commit();
  EXPECT_GT(world.tree.upkeep().sorted_last, 4000U);
  expect_equal(snapshot, model, world.random());
  expect_equal(world.tree.committed(), world.model, world.random());
}

// Of so many changes a commit goes through all blocks, and not from change to change.
TYPED_TEST(DynamicTrees, AnswerAsAnArrayDoesWhereNearlyAllMove) {
  for (const bool layers : {false, true}) {
    World<TypeParam> world(layers ? 19 : 20);
    world.change({.count = 22000, .insertions = 10, .layers = layers});
    world.tree.commit();
    for (unsigned frame = 0; frame != 4; ++frame) {
      const Model<TypeParam> before = world.model;
      const TreeSnapshot<TypeParam> snapshot = frame % 2 == 0 ? TreeSnapshot<TypeParam>() : world.tree.snapshot();
      for (std::uint32_t i = 0; i != world.model.bounds.size(); ++i) {
        if (world.model.has_bound[i] == 0 || (i + frame) % 9 == 0) continue;
        const float step = i % 100 == 0 ? 5.0F : 0.02F;  // some leave their blocks
        world.tree.move_by(world.model.ids[i], world.random().vec3(-step, step));
        world.model.bounds[i] = world.tree[world.model.ids[i]];
      }
      world.change({.count = 500, .layers = layers});
      world.tree.commit();
      expect_equal(world.tree.committed(), world.model, world.random());
      if (frame % 2 == 1) expect_equal(snapshot, before, world.random());
    }
  }
}

// Bounds of a full word go to another one, with indices that no change has named.
TYPED_TEST(DynamicTrees, SnapshotsStayAsTheyAreWhereWordsAreSplit) {
  World<TypeParam> world(16);
  world.change({.count = 20000, .insertions = 10});
  world.tree.commit();
  std::vector<std::pair<TreeSnapshot<TypeParam>, Model<TypeParam>>> before;
  for (std::uint32_t commit = 0; commit != 4; ++commit) {
    before.emplace_back(world.tree.snapshot(), world.model);
    const TypeParam bound = world.model.bounds[1000 * commit];
    for (unsigned i = 0; i != 80; ++i) world.model.insert(world.tree.insert(bound), bound, all_layers);
    world.tree.commit();
  }
  for (const auto& [snapshot, model] : before) expect_equal(snapshot, model, world.random());
  expect_equal(world.tree.committed(), world.model, world.random());
}

// Indices get a page of places with each 4,096 of them, also where a commit changes the last state.
TYPED_TEST(DynamicTrees, AnswerForCandidatesOnANewPage) {
  World<TypeParam> world(22);
  world.change({.count = 4090, .insertions = 10});
  world.tree.commit();
  world.change({.count = 20, .insertions = 10});
  world.tree.commit();
  EXPECT_EQ(world.tree.upkeep().sorted_last, 0U);
  ASSERT_GT(world.model.bounds.size(), 4096U);
  expect_equal(world.tree.committed(), world.model, world.random());
  const CompiledShaft all =
      compile({{-1e6F, -1e6F, -1e6F}, {1e6F, 1e6F, 1e6F}}, {{-1e6F, -1e6F, -1e6F}, {1e6F, 1e6F, 1e6F}});
  const Indices last{4095, 4096, 4109};
  Indices kept;
  list(all, world.tree, kept, {.only = last});
  EXPECT_EQ(kept, last);
}

constexpr Box around{{-1, -1, -1}, {101, 101, 101}};

// More than 128 blocks: nodes above those of blocks are fitted, too.
TEST(DynamicBoxes, AreFoundWhereTheTreeHasFourLevels) {
  DynamicBoxTree tree;
  tree.set_sorted_per_change(0);  // so that commits sort nothing, and change blocks in place
  Random random(19);
  std::vector<Box> boxes;
  for (unsigned i = 0; i != 480000; ++i) boxes.push_back(random.box(0, 100, 0.01F, 0.02F));
  std::vector<BoundId> ids(boxes.size());
  tree.insert(boxes, ids);
  tree.commit();
  EXPECT_GT(tree.upkeep().blocks, 128U);
  for (unsigned i = 0; i != 10; ++i) {
    const float x = 200 + 10 * static_cast<float>(i);
    const Box away{{x, 0, 0}, {x + 1, 1, 1}};
    tree.move(ids[1000 * i], away);
    tree.commit();
    EXPECT_EQ(tree.upkeep().sorted_last, 0U);
    EXPECT_EQ(count(compile(away, away), tree), 1U) << i;
  }
}

TEST(DynamicBoxes, ThatAreEmptyAreInNoShaft) {
  DynamicBoxTree tree;
  const CompiledShaft all = compile(around, around);
  Random random(17);
  std::vector<BoundId> ids;
  for (unsigned i = 0; i != 500; ++i) ids.push_back(tree.insert(random.box(0, 100, 0.1F, 0.5F)));
  tree.commit();
  for (unsigned i = 0; i < 500; i += 5) tree.move(ids[i], empty_box);
  tree.commit();
  EXPECT_EQ(count(all, tree), 400U);
  EXPECT_EQ(count_classified(all, tree).inside, 400U);
}

TEST(DynamicBoxes, AreFoundByTheirOwnLayer) {
  DynamicBoxTree tree;
  const CompiledShaft all = compile(around, around);
  Random random(18);
  for (unsigned layer = 0; layer != 32; ++layer) tree.insert(random.box(0, 100, 0.1F, 0.5F), 1U << layer);
  tree.commit();
  for (unsigned layer = 0; layer != 32; ++layer) {
    EXPECT_EQ(count(all, tree, {.layer_mask = {1U << layer}}), 1U) << layer;
  }
}

TYPED_TEST(DynamicTrees, ASnapshotThatIsMovedFromHoldsNothing) {
  World<TypeParam> world(13);
  world.change({.count = 100, .insertions = 10});
  world.tree.commit();
  TreeSnapshot<TypeParam> one = world.tree.snapshot();
  world.change({.count = 100, .insertions = 10});
  world.tree.commit();
  TreeSnapshot<TypeParam> other = world.tree.snapshot();
  one = std::move(other);
  EXPECT_EQ(one.bound_count(), world.model.count());
  EXPECT_EQ(other.bound_count(), 0U);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  TreeSnapshot<TypeParam>& itself = one;
  one = std::move(itself);
  EXPECT_EQ(one.bound_count(), world.model.count());
}

TYPED_TEST(DynamicTrees, ChangesAreSeenAfterTheCommitAndNotBefore) {
  World<TypeParam> world(6);
  world.change({.count = 500});
  world.tree.commit();
  const Model<TypeParam> committed = world.model;
  world.change({.count = 500});
  expect_equal(world.tree.committed(), committed, world.random());
  world.tree.commit();
  expect_equal(world.tree.committed(), world.model, world.random());
}

// Erased and inserted, moved and erased, erased twice over in one frame.
TYPED_TEST(DynamicTrees, OneFrameMayChangeABoundManyTimes) {
  World<TypeParam> world(7);
  world.change({.count = 100, .insertions = 10});
  world.tree.commit();
  for (int frame = 0; frame != 20; ++frame) {
    world.change({.count = 2000, .layers = frame > 10});
    world.tree.commit();
    expect_equal(world.tree.committed(), world.model, world.random());
  }
}

TYPED_TEST(DynamicTrees, NothingIsATreeToo) {
  World<TypeParam> world(8);
  const TreeSnapshot<TypeParam> none;
  expect_equal(none, world.model, world.random());
  expect_equal(world.tree.committed(), world.model, world.random());
  world.tree.commit();
  expect_equal(world.tree.committed(), world.model, world.random());
  EXPECT_EQ(none.box(), empty_box);
  world.change({.count = 5000, .insertions = 10});
  world.tree.commit();
  for (std::uint32_t i = 0; i != world.model.bounds.size(); ++i) {
    world.tree.erase(world.model.ids[i]);
    world.model.erase(i);
  }
  world.tree.commit();
  expect_equal(world.tree.committed(), world.model, world.random());
  EXPECT_EQ(world.tree.committed().box(), empty_box);
  world.change({.count = 100});
  world.tree.commit();
  expect_equal(world.tree.committed(), world.model, world.random());
}

TYPED_TEST(DynamicTrees, TheBoxIsAroundAllBounds) {
  World<TypeParam> world(9);
  for (int frame = 0; frame != 10; ++frame) {
    world.change({.count = 2000, .insertions = 6});
    world.tree.commit();
    std::vector<TypeParam> bounds;
    for (std::uint32_t i = 0; i != world.model.bounds.size(); ++i) {
      if (world.model.has_bound[i] != 0) bounds.push_back(world.model.bounds[i]);
    }
    const BoundsTree<TypeParam> fresh{std::span<const TypeParam>(bounds)};
    EXPECT_EQ(world.tree.committed().box(), fresh.box());
  }
}

TYPED_TEST(DynamicTrees, RebuildingSortsEverythingAndCommits) {
  World<TypeParam> world(11);
  world.tree.rebuild();
  for (int frame = 0; frame != 6; ++frame) {
    world.change({.shape = Shape::wild_sizes, .count = 3000, .insertions = 6, .layers = frame > 2});
    const TreeSnapshot<TypeParam> before = world.tree.snapshot();
    const std::size_t count = before.bound_count();
    world.tree.rebuild();
    EXPECT_EQ(world.tree.upkeep().sorted_last, world.model.count());
    EXPECT_EQ(world.tree.upkeep().sah_ratio, 1);
    expect_equal(world.tree.committed(), world.model, world.random());
    EXPECT_EQ(before.bound_count(), count);
  }
}

TYPED_TEST(DynamicTrees, WhatWasMovedFromIsAnEmptyTree) {
  World<TypeParam> world(12);
  world.change({.count = 300, .insertions = 8});
  world.tree.commit();
  DynamicTree<TypeParam> moved = std::move(world.tree);
  expect_equal(moved.committed(), world.model, world.random());
  DynamicTree<TypeParam>& empty = world.tree;
  EXPECT_EQ(empty.bound_count(), 0U);
  EXPECT_EQ(empty.memory_bytes(), 0U);
  EXPECT_EQ(empty.upkeep().blocks, 0U);
  EXPECT_EQ(empty.snapshot().bound_count(), 0U);
  EXPECT_EQ(empty.committed().index_end(), 0U);
  EXPECT_FALSE(empty.has({0, 0}));
  EXPECT_EQ(empty.id_of(0), BoundId{});
  EXPECT_THROW((void)empty[BoundId{}], InvalidArgument);
  EXPECT_THROW(empty.erase({0, 0}), InvalidArgument);
  empty.commit();
  empty.rebuild();
  empty.set_sorted_per_change(1);
  world.model = {};
  world.change({.count = 300, .insertions = 8});
  empty.commit();
  expect_equal(empty.committed(), world.model, world.random());
}

/// The order of lists, and so the tree itself, after the same changes.
template <class Bound>
Indices order_after_changes(int threads, bool holds_snapshots) {
  Indices all;
  with_threads(threads, [&] {
    World<Bound> world(10);
    std::vector<TreeSnapshot<Bound>> held;
    for (int frame = 0; frame != 12; ++frame) {
      world.change({.shape = Shape::wild_sizes, .count = 3000, .insertions = frame < 6 ? 9U : 3U});
      world.tree.commit();
      if (holds_snapshots) held.push_back(world.tree.snapshot());
    }
    const CompiledShaft shaft = compile({{-50, -50, -50}, {-50, 50, 50}}, {{50, -50, -50}, {50, 50, 50}});
    list(shaft, world.tree, all);
  });
  return all;
}

#ifdef SHAFTCULL_HAS_FLOAT_MODES
TYPED_TEST(DynamicTrees, AreTheSameInEveryFloatingPointMode) {
  const Indices expected = order_after_changes<TypeParam>(1, false);
  for (const Mode& mode : modes) {
    const InMode in(mode);
    EXPECT_EQ(order_after_changes<TypeParam>(1, false) == expected, true) << mode.name;
  }
}
#endif

TYPED_TEST(DynamicTrees, AreTheSameOnEveryInstructionSet) {
  const Indices expected = order_after_changes<TypeParam>(1, false);
  for (const Isa isa : available_isas()) {
    const UseIsa use(isa);
    EXPECT_EQ(order_after_changes<TypeParam>(1, false) == expected, true) << name(isa);
  }
}

TYPED_TEST(DynamicTrees, ListsDependOnTheCallsAlone) {
  const Indices expected = order_after_changes<TypeParam>(1, false);
  EXPECT_GT(expected.size(), 10000U);
  EXPECT_EQ(order_after_changes<TypeParam>(4, false), expected);
  EXPECT_EQ(order_after_changes<TypeParam>(2, true), expected);
}

}  // namespace
}  // namespace shaftcull
