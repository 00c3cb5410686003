// SPDX-License-Identifier: MIT
/// Bounds that move: updates, refits and rebuilds leave a tree that answers what a flat scan of the new bounds answers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "columns.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/tree_image.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

template <class Tree>
class TreeFrames : public testing::Test {
 protected:
  /// Whether both answer the same, asked by some shafts.
  static void expect_flat_answers(const Tree& tree, const std::vector<BoundOf<Tree>>& bounds, std::uint64_t seed) {
    Random random(seed);
    const std::vector<CompiledShaft> shafts = shafts_for(random, 8);
    IndexLists overlap;
    IndexLists inside;
    list_classified_many(shafts, tree, overlap, inside);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      const FlatAnswers flat(shafts[s], bounds);
      EXPECT_EQ(sorted(overlap[s]), flat.overlap) << "seed " << seed << ", shaft " << s;
      EXPECT_EQ(sorted(inside[s]), flat.inside) << "seed " << seed << ", shaft " << s;
    }
  }
};

TYPED_TEST_SUITE(TreeFrames, TreeKinds);

constexpr std::size_t counts[] = {0, 1, 64, 65, 129, 4097, 20000};

TYPED_TEST(TreeFrames, UpdatingEverythingFromRecordsOrStreamsEqualsTheNewBounds) {
  using Bound = BoundOf<TypeParam>;
  Random random(71);
  for (const std::size_t count : counts) {
    TypeParam tree{std::span<const Bound>(scene<Bound>(random, Shape::uniform, count))};
    for (const Shape shape : shapes) {
      const std::vector<Bound> moved = scene<Bound>(random, shape, count);
      if (random.one_in(2)) {
        tree.update(std::span<const Bound>(moved));
      } else {
        tree.update(columns(moved).view());
      }
      EXPECT_FALSE(tree.needs_refit());
      this->expect_flat_answers(tree, moved, 710 + count);
    }
  }
}

TYPED_TEST(TreeFrames, UpdatingSomeAndRefittingEqualsTheNewBounds) {
  using Bound = BoundOf<TypeParam>;
  Random random(72);
  for (const std::size_t count : counts) {
    if (count == 0) continue;
    for (const Shape shape : shapes) {
      std::vector<Bound> bounds = scene<Bound>(random, shape, count);
      TypeParam tree{std::span<const Bound>(bounds)};
      for (const std::size_t moves : {std::size_t{1}, count / 100 + 1, count}) {  // few and many dirty nodes
        std::vector<std::uint32_t> indices;
        const std::vector<Bound> values = scene<Bound>(random, shapes[random.below(std::size(shapes))], moves);
        for (const Bound& value : values) {
          indices.push_back(random.below(static_cast<unsigned>(count)));  // some twice: the last value counts
          bounds[indices.back()] = value;
        }
        tree.update(indices, std::span<const Bound>(values));
        EXPECT_TRUE(tree.needs_refit());
        tree.refit();
        EXPECT_FALSE(tree.needs_refit());
        this->expect_flat_answers(tree, bounds, 720 + count);
        if (testing::Test::HasFailure()) FAIL() << text(shape) << ", " << count << " bounds, " << moves << " moved";
      }
    }
  }
}

TYPED_TEST(TreeFrames, RefittingFewNodesLeavesTheTreeThatRefittingAllDoes) {
  using Bound = BoundOf<TypeParam>;
  Random random(73);
  std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, 20000);
  TypeParam few{std::span<const Bound>(bounds)};
  TypeParam all = few;
  const std::vector<Bound> values = scene<Bound>(random, Shape::uniform, 9);
  std::vector<std::uint32_t> indices;
  for (const Bound& value : values) {
    indices.push_back(random.below(20000));
    bounds[indices.back()] = value;
  }
  few.update(indices, std::span<const Bound>(values));
  few.refit();
  all.update(std::span<const Bound>(bounds));
  EXPECT_EQ(few.sah_ratio(), all.sah_ratio());
  std::vector<std::byte> image_of_few(image_bytes(few));
  std::vector<std::byte> image_of_all(image_bytes(all));
  write_image(few, image_of_few);
  write_image(all, image_of_all);
  EXPECT_EQ(image_of_few == image_of_all, true);
}

TEST(TreeFramesOfBoxes, ABoxThatBecomesEmptyIsNotInsideANodeThatIs) {
  Random random(78);
  BoxTree tree{std::span<const Box>(scene<Box>(random, Shape::uniform, 600000))};
  const CompiledShaft everything = compile({{-9, -9, -9}, {9, 9, 9}}, {{-9, -9, -9}, {9, 9, 9}});
  const std::vector<std::uint32_t> index = {123456};
  for (const bool is_empty : {false, true, false}) {
    tree.update(index, std::vector<Box>{is_empty ? empty_box : Box{{0, 0, 0}, {1, 1, 1}}});
    tree.refit();
    EXPECT_EQ(count_classified(everything, tree), (KeptCounts{0, is_empty ? 599999U : 600000U}));
    EXPECT_EQ(list_classified(everything, tree, std::span<std::uint32_t>(), std::span<std::uint32_t>()),
              (KeptCounts{0, is_empty ? 599999U : 600000U}));
  }
}

TYPED_TEST(TreeFrames, RebuildingRestoresTheQualityAndKeepsIndices) {
  using Bound = BoundOf<TypeParam>;
  Random random(74);
  TypeParam tree{std::span<const Bound>(scene<Bound>(random, Shape::uniform, 20000))};
  EXPECT_EQ(tree.sah_ratio(), 1.0);
  const std::vector<Bound> shuffled = scene<Bound>(random, Shape::uniform, 20000);
  tree.update(std::span<const Bound>(shuffled));
  EXPECT_GT(tree.sah_ratio(), 10.0);
  tree.rebuild();
  EXPECT_EQ(tree.sah_ratio(), 1.0);
  this->expect_flat_answers(tree, shuffled, 741);
  const std::vector<Bound> again = scene<Bound>(random, Shape::uniform, 20000);
  const std::vector<std::uint32_t> indices = {5, 19999};
  tree.update(indices, std::span<const Bound>(again).first(2));
  tree.refit();
  std::vector<Bound> bounds = shuffled;
  bounds[5] = again[0];
  bounds[19999] = again[1];
  this->expect_flat_answers(tree, bounds, 742);
}

TYPED_TEST(TreeFrames, GrowthIsDefinedForNodesWithoutSurface) {
  using Bound = BoundOf<TypeParam>;
  const std::vector<Bound> points(1000, Bound{});
  TypeParam tree{std::span<const Bound>(points)};
  EXPECT_EQ(tree.sah_ratio(), 1.0);
  if constexpr (std::is_same_v<Bound, Box>) {  // the nodes of spheres are rounded outwards
    const std::vector<std::uint32_t> one = {3};
    const std::vector<Bound> away = {{{1, 1, 1}, {2, 2, 2}}};
    tree.update(one, std::span<const Bound>(away));
    tree.refit();
    EXPECT_EQ(tree.sah_ratio(), HUGE_VAL);
  }
}

TYPED_TEST(TreeFrames, ReorderingMakesTreeOrderTheUsersOrder) {
  using Bound = BoundOf<TypeParam>;
  Random random(79);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, 5000);
  for (const bool updated_before : {false, true}) {
    TypeParam tree{std::span<const Bound>(bounds)};
    if (updated_before) {
      tree.update(std::vector<std::uint32_t>{7}, std::span<const Bound>(bounds).subspan(7, 1));
      tree.refit();
    }
    std::vector<Bound> sorted;
    for (const std::uint32_t i : tree.order()) sorted.push_back(bounds[i]);
    tree.reorder();
    this->expect_flat_answers(tree, sorted, 791);
    sorted[33] = sorted[4000];
    tree.update(std::vector<std::uint32_t>{33}, std::span<const Bound>(sorted).subspan(33, 1));
    tree.refit();
    this->expect_flat_answers(tree, sorted, 792);
    tree.update(std::span<const Bound>(bounds));
    this->expect_flat_answers(tree, bounds, 793);
  }
}

TYPED_TEST(TreeFrames, LeavesAndOrderShowTheBounds) {
  using Bound = BoundOf<TypeParam>;
  Random random(75);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, 777);
  const TypeParam tree{columns(bounds).view()};
  std::vector<bool> seen(bounds.size());
  for (std::size_t p = 0; p != bounds.size(); ++p) {
    EXPECT_EQ(tree.leaves()[p], bounds[tree.order()[p]]);
    seen[tree.order()[p]] = true;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 777);
}

TYPED_TEST(TreeFrames, CopiesAreDeepAndMovesLeaveAnEmptyTree) {
  using Bound = BoundOf<TypeParam>;
  Random random(76);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, 5000);
  TypeParam first{std::span<const Bound>(bounds)};
  TypeParam second = first;
  const std::vector<Bound> moved = scene<Bound>(random, Shape::clustered, 5000);
  second.update(std::span<const Bound>(moved));
  this->expect_flat_answers(first, bounds, 761);
  this->expect_flat_answers(second, moved, 762);
  first = std::move(second);
  this->expect_flat_answers(first, moved, 763);
  EXPECT_EQ(second.size(), 0U);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  EXPECT_TRUE(second.order().empty());
  EXPECT_EQ(second.leaves().count, 0U);
  this->expect_flat_answers(second, {}, 764);
  second.update(std::span<const Bound>());
  second.rebuild();
  second.refit();
  EXPECT_EQ(second.sah_ratio(), 1.0);
}

TYPED_TEST(TreeFrames, NodesTakeLittleNextToLeavesAndOrder) {
  using Bound = BoundOf<TypeParam>;
  Random random(77);
  const std::size_t count = 400000;
  const TypeParam tree{std::span<const Bound>(scene<Bound>(random, Shape::uniform, count))};
  const std::size_t needed = count * (tree.leaves().stream.size() * sizeof(float) + sizeof(std::uint32_t));
  const std::size_t per_mille = std::is_same_v<Bound, Box> ? 20 : 25;  // a sphere is four numbers, its node six
  EXPECT_LT(tree.memory_bytes(), needed + needed * per_mille / 1000);
}

TYPED_TEST(TreeFrames, UpdatesByIndexTakeOneMoreIndexABound) {
  using Bound = BoundOf<TypeParam>;
  Random random(80);
  const std::size_t count = 400000;
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, count);
  TypeParam tree{std::span<const Bound>(bounds)};
  const std::size_t before = tree.memory_bytes();
  for (int again = 0; again != 2; ++again) {
    tree.update(std::vector<std::uint32_t>{7}, std::span<const Bound>(bounds).subspan(8, 1));
    tree.refit();
    EXPECT_LT(tree.memory_bytes() - before, count * sizeof(std::uint32_t) + count / 256);
  }
}

}  // namespace
}  // namespace shaftcull
