// SPDX-License-Identifier: MIT
/// An exception out of the middle of a call: from an update or refit that does not end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "message_of.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/tree_access.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

template <class Tree>
class TreeExceptions : public testing::Test {
 protected:
  static void expect_flat_answers(const Tree& tree, const std::vector<CompiledShaft>& shafts,
                                  const std::vector<BoundOf<Tree>>& bounds) {
    IndexLists kept;
    list_many(shafts, tree, kept);
    for (std::size_t s = 0; s != shafts.size(); ++s) ASSERT_EQ(sorted(kept[s]), FlatAnswers(shafts[s], bounds).kept());
  }
};
TYPED_TEST_SUITE(TreeExceptions, TreeKinds);

/// A tree as update() of all bounds leaves it if it is ended by an exception: some leaves have their new value, and
/// nodes were not fitted.
TYPED_TEST(TreeExceptions, AnUpdateThatDidNotEndAsksForARefit) {
  using Bound = BoundOf<TypeParam>;
  Random random(82);
  const std::vector<CompiledShaft> shafts = shafts_for(random, 20);
  for (const std::size_t count : {10U, 64U, 5000U, 20000U}) {
    std::vector<Bound> bounds = scene<Bound>(random, Shape::clustered, count);
    const std::vector<Bound> news = scene<Bound>(random, Shape::uniform, count);
    TypeParam tree{std::span<const Bound>(bounds)};
    auto& parts = *TreeAccess::parts(tree);
    parts.mark_all_dirty();
    const auto row = parts.leaf_rows();
    for (std::size_t p = 0; p < count; p += 3) {
      const Bound& bound = bounds[tree.order()[p]] = news[p];
      if constexpr (std::is_same_v<Bound, Box>) {
        for (std::size_t k = 0; k != 3; ++k) row[k][p] = bound.lo[k], row[k + 3][p] = bound.hi[k];
      } else {
        for (std::size_t k = 0; k != 3; ++k) row[k][p] = bound.centre[k];
        row[3][p] = bound.radius;
      }
    }
    EXPECT_TRUE(tree.needs_refit());
    EXPECT_THAT(message_of<NeedsRefit>([&] { static_cast<void>(shaftcull::count(shafts[0], tree)); }),
                testing::HasSubstr("call refit() first"));
    TypeParam copy = tree;
    TypeParam updated = tree;
    tree.refit();
    EXPECT_FALSE(tree.needs_refit());
    this->expect_flat_answers(tree, shafts, bounds);

    copy.rebuild();
    EXPECT_FALSE(copy.needs_refit());
    this->expect_flat_answers(copy, shafts, bounds);

    const std::vector<std::uint32_t> one = {static_cast<std::uint32_t>(count - 1)};
    updated.update(one, std::span<const Bound>(news).first(1));
    bounds[one[0]] = news[0];
    updated.refit();
    this->expect_flat_answers(updated, shafts, bounds);

    updated.update(std::span<const Bound>(news));
    EXPECT_FALSE(updated.needs_refit());
    this->expect_flat_answers(updated, shafts, news);
  }
}

}  // namespace
}  // namespace shaftcull
