// SPDX-License-Identifier: MIT
/// Trees that are built once more: whatever they went through, they are those that are built of their bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "columns.hpp"
#include "oracle/random.hpp"
#include "shaftcull/tree.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

template <class Tree>
class TreeRebuilding : public testing::Test {};
TYPED_TEST_SUITE(TreeRebuilding, TreeKinds);

/// Sizes that are built by one thread, and by all.
constexpr std::size_t counts[] = {1, 100, 4097, 70000};

TYPED_TEST(TreeRebuilding, OfUnchangedBoundsMovesNothing) {
  using Bound = BoundOf<TypeParam>;
  Random random(741);
  for (const Shape shape : shapes) {
    for (const std::size_t count : counts) {
      const std::vector<Bound> bounds = scene<Bound>(random, shape, count);
      TypeParam tree{std::span<const Bound>(bounds)};
      const std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
      tree.rebuild();
      EXPECT_EQ(std::equal(order.begin(), order.end(), tree.order().begin()), true) << text(shape) << ", " << count;
    }
  }
}

TYPED_TEST(TreeRebuilding, GivesAnOrderThatDoesNotDependOnWhatTheTreeWentThrough) {
  using Bound = BoundOf<TypeParam>;
  Random random(742);
  for (const Shape shape : shapes) {
    for (const std::size_t count : counts) {
      const std::vector<Bound> bounds = scene<Bound>(random, shape, count);
      const TypeParam built{columns(bounds).view()};

      TypeParam moved{std::span<const Bound>(scene<Bound>(random, Shape::uniform, count))};
      moved.rebuild();
      moved.update(std::span<const Bound>(scene<Bound>(random, Shape::clustered, count)));
      moved.rebuild();
      std::vector<std::uint32_t> indices(count);
      for (std::size_t i = 0; i != count; ++i) indices[i] = static_cast<std::uint32_t>(count - 1 - i);
      moved.update(indices, std::span<const Bound>(std::vector<Bound>(bounds.rbegin(), bounds.rend())));
      if (random.one_in(2)) moved.refit();  // a rebuild does that, too
      moved.rebuild();
      EXPECT_FALSE(moved.needs_refit());
      const auto order = built.order();
      EXPECT_EQ(std::equal(order.begin(), order.end(), moved.order().begin()), true) << text(shape) << ", " << count;
      for (std::size_t p = 0; p != count; ++p) ASSERT_EQ(moved.leaves()[p], built.leaves()[p]);
      EXPECT_EQ(moved.sah_ratio(), 1.0);
    }
  }
}

}  // namespace
}  // namespace shaftcull
