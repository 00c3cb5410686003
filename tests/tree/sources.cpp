// SPDX-License-Identifier: MIT
/// What trees are built of and updated from: the same bounds make the same tree, wherever they come from. And the box
/// around them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "message_of.hpp"
#include "shaftcull/tree.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

// Trees of boxes alone take centres and half extents.
static_assert(std::is_constructible_v<BoxTree, const StridedCentreExtents&>);
static_assert(!std::is_constructible_v<SphereTree, const StridedCentreExtents&>);

using testing::HasSubstr;

template <class Tree>
class TreeSources : public testing::Test {
 protected:
  static std::vector<BoundOf<Tree>> leaves_of(const Tree& tree) {
    std::vector<BoundOf<Tree>> leaves;
    for (std::size_t p = 0; p != tree.size(); ++p) leaves.push_back(tree.leaves()[p]);
    return leaves;
  }
  static void expect_equal(const Tree& one, const Tree& other) {
    EXPECT_EQ(leaves_of(one) == leaves_of(other), true);
    EXPECT_TRUE(std::equal(one.order().begin(), one.order().end(), other.order().begin(), other.order().end()));
  }
};
TYPED_TEST_SUITE(TreeSources, TreeKinds);

TYPED_TEST(TreeSources, ViewsStreamsAndArraysOfTheSameBoundsMakeTheSameTree) {
  using Bound = BoundOf<TypeParam>;
  Random random(71);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::wild_sizes, 3000);
  const auto memory = columns(bounds);
  const TypeParam tree{std::span<const Bound>(bounds)};
  this->expect_equal(TypeParam(memory.view()), tree);
  this->expect_equal(TypeParam(strided(std::span<const Bound>(bounds))), tree);
  using Stream = std::conditional_t<std::is_same_v<Bound, Box>, BoxStream, SphereStream>;
  const Stream stream(bounds);
  this->expect_equal(TypeParam(stream), tree);
  TypeParam updated = tree;
  updated.update(stream);
  this->expect_equal(updated, tree);
}

TYPED_TEST(TreeSources, CopiesHoldAllThatTheTreeHeld) {
  using Bound = BoundOf<TypeParam>;
  Random random(72);
  const std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, 3000);
  const std::vector<std::uint32_t> some = {5, 2999, 17};
  TypeParam tree{std::span<const Bound>(bounds)};
  const std::size_t as_built = tree.memory_bytes();
  tree.update(some, std::span<const Bound>(bounds).first(3));
  EXPECT_GE(tree.memory_bytes(), as_built + tree.size() * sizeof(std::uint32_t));
  TypeParam copy = tree;
  EXPECT_TRUE(copy.needs_refit());
  EXPECT_GE(copy.memory_bytes(), as_built + tree.size() * sizeof(std::uint32_t))
      << "the places of indices are not copied";
  copy.refit();
  EXPECT_TRUE(tree.needs_refit());
  tree.refit();
  this->expect_equal(copy, tree);
  EXPECT_EQ(copy.box(), tree.box());
  EXPECT_EQ(copy.sah_ratio(), tree.sah_ratio());
}

TYPED_TEST(TreeSources, TheBoxOfATreeIsTheOneAroundItsBounds) {
  using Bound = BoundOf<TypeParam>;
  Random random(73);
  EXPECT_EQ(TypeParam().box(), empty_box);
  for (const Shape shape : shapes) {
    for (const std::size_t count : {1U, 64U, 65U, 129U, 9000U}) {
      const std::vector<Bound> bounds = scene<Bound>(random, shape, count);
      const Box box = TypeParam{std::span<const Bound>(bounds)}.box();
      Box around = empty_box;
      for (const Bound& bound : bounds) {
        for (std::size_t k = 0; k != 3; ++k) {
          if constexpr (std::is_same_v<Bound, Box>) {
            around.lo[k] = std::min(around.lo[k], bound.lo[k]);
            around.hi[k] = std::max(around.hi[k], bound.hi[k]);
          } else {
            around.lo[k] = std::min(around.lo[k], bound.centre[k] - bound.radius);
            around.hi[k] = std::max(around.hi[k], bound.centre[k] + bound.radius);
          }
        }
      }
      for (std::size_t k = 0; k != 3; ++k) {
        if constexpr (std::is_same_v<Bound, Box>) {
          EXPECT_EQ(box.lo[k], around.lo[k]) << text(shape) << ", " << count;
          EXPECT_EQ(box.hi[k], around.hi[k]) << text(shape) << ", " << count;
        } else {  // a little larger
          EXPECT_LE(box.lo[k], around.lo[k]) << text(shape) << ", " << count;
          EXPECT_GE(box.hi[k], around.hi[k]) << text(shape) << ", " << count;
          if (!std::isfinite(around.lo[k])) continue;
          const float least = 1e-37F + 1e-5F * (std::abs(around.lo[k]) + std::abs(around.hi[k]));
          EXPECT_NEAR(box.lo[k], around.lo[k], least) << text(shape) << ", " << count;
          EXPECT_NEAR(box.hi[k], around.hi[k], least) << text(shape) << ", " << count;
        }
      }
    }
  }
}

TYPED_TEST(TreeSources, TheBoxFollowsUpdatesAndWaitsForARefit) {
  using Bound = BoundOf<TypeParam>;
  Random random(74);
  TypeParam tree{std::span<const Bound>(scene<Bound>(random, Shape::uniform, 5000))};
  const std::vector<Bound> far = {[] {
    if constexpr (std::is_same_v<Bound, Box>) {
      return Box{{90, 90, 90}, {100, 100, 100}};
    } else {
      return Sphere{{95, 95, 95}, 5};
    }
  }()};
  const std::vector<std::uint32_t> index = {1234};
  tree.update(index, std::span<const Bound>(far));
  EXPECT_THROW(static_cast<void>(tree.box()), NeedsRefit);
  tree.refit();
  EXPECT_GE(tree.box().hi[0], 100);
  EXPECT_LT(tree.box().hi[0], 100.001F);
}

/// Boxes as centre and half extent, with corners that are floats and others that are not.
struct CentredBoxes {
  struct Record {
    Vec3 centre;
    Vec3 half;
  };
  std::vector<Record> record;

  explicit CentredBoxes(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    for (std::size_t i = 0; i != count; ++i) record.push_back({random.vec3(-5, 5), random.vec3(0, 0.3F)});
  }
  [[nodiscard]] StridedCentreExtents records() const {
    return {record.data()->centre.data(), record.data()->half.data(), sizeof(Record), record.size()};
  }
};

template <class Tree>
class BoxTreeSources : public TreeSources<Tree> {};
using BoxTreeKinds = testing::Types<BoxTree, BoundsTree<Box>>;
TYPED_TEST_SUITE(BoxTreeSources, BoxTreeKinds);

TYPED_TEST(BoxTreeSources, CentresAndHalfExtentsMakeTheTreeOfWhatTheyArePackedInto) {
  const CentredBoxes first(40000, 75);
  const CentredBoxes second(40000, 76);
  const BoxStream packed_first(first.records());
  const BoxStream packed_second(second.records());
  TypeParam tree(first.records());
  TypeParam expected(packed_first.view());
  this->expect_equal(tree, expected);

  const std::vector<std::uint32_t> some = {7, 39999, 20000};
  CentredBoxes three = second;
  three.record.resize(3);
  tree.update(some, three.records());
  expected.update(some, packed_second.view().slice(0, 3));
  tree.refit();
  expected.refit();
  this->expect_equal(tree, expected);

  tree.update(second.records());
  expected.update(packed_second.view());
  this->expect_equal(tree, expected);
}

TYPED_TEST(BoxTreeSources, ABadHalfExtentIsNamedEvenIfItVanishesInRounding) {
  CentredBoxes boxes(40000, 77);
  const TypeParam good(boxes.records());
  for (const float bad : {-1.0F, -1e-30F, NAN}) {
    CentredBoxes some_bad = boxes;
    some_bad.record[30000].half[1] = bad;
    some_bad.record[30001].half[1] = bad;
    const auto refusal = HasSubstr("box 30000: ");
    EXPECT_THAT(message_of([&] { TypeParam{some_bad.records()}; }), refusal) << bad;
    TypeParam tree = good;
    EXPECT_THAT(message_of([&] { tree.update(some_bad.records()); }), refusal) << bad;
    EXPECT_FALSE(tree.needs_refit());
    this->expect_equal(tree, good);
  }
}

}  // namespace
}  // namespace shaftcull
