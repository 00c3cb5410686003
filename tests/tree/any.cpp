// SPDX-License-Identifier: MIT
/// A walk that looks for any bound ends at the first one, and one that looks for so many when it has found them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "tree/counted_words.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/tree_access.hpp"
#include "tree/walked.hpp"

namespace shaftcull {
namespace {

/// Words of leaves and nodes that a walk with this visitor tests.
template <class Visitor>
std::size_t words_tested_by(Visitor& visitor, const BoxTree& tree, const CompiledShaft& shaft) {
  const kernel::Kernels kernels = counting_kernels();
  walk(*TreeAccess::parts(tree), kernels, shaft, kernel::Question::kept, visitor);
  return words_tested;
}

TEST(TreeAny, EndsAtTheFirstBoundThatIsKept) {
  Random random(91);
  const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 300000);
  const BoxTree tree{std::span<const Box>(boxes)};
  // Reaches all boxes; thin, so that no node is inside and walks go down to the leaves.
  const CompiledShaft shaft = compile({{-6, -6, 0}, {6, 6, 0.01F}}, {{-6, -6, 0}, {6, 6, 0.01F}});
  kernel::Counter counter(kernel::active_kernels());
  const std::size_t all = words_tested_by(counter, tree, shaft);
  kernel::Finder finder;
  const std::size_t few = words_tested_by(finder, tree, shaft);
  EXPECT_GT(counter.result(), 1000U);
  EXPECT_TRUE(finder.is_done());
  EXPECT_GT(all, 100U);
  EXPECT_LE(few, 20U) << "of " << all;
}

TEST(TreeAny, EndsAtANodeThatIsInside) {
  const std::vector<Box> boxes(300000, Box{{0, 0, 0}, {1, 1, 1}});
  const BoxTree tree{std::span<const Box>(boxes)};
  kernel::Finder finder;
  CompiledShaft shaft = compile({{-1, -1, -1}, {2, 2, 2}}, {{-1, -1, -1}, {2, 2, 2}});
  complete(shaft);
  EXPECT_LE(words_tested_by(finder, tree, shaft), 2U);
  EXPECT_TRUE(finder.is_done());
}

TEST(TreeAny, LooksOnWhereWhatItFindsIsLeftOut) {
  const std::vector<Box> boxes(5000, Box{{0, 0, 0}, {1, 1, 1}});
  const BoxTree tree{std::span<const Box>(boxes)};
  const CompiledShaft shaft = compile({{-1, -1, -1}, {2, 2, 2}}, {{-1, -1, -1}, {2, 2, 2}});
  std::vector<std::uint64_t> mask(bit_words(boxes.size()), ~std::uint64_t{0});
  EXPECT_TRUE(any(shaft, tree));
  EXPECT_FALSE(any(shaft, tree, {.exclude_mask = mask}));
  for (const std::uint32_t index : {0U, 63U, 64U, 4095U, 4999U}) {
    mask[index / 64] &= ~(std::uint64_t{1} << index % 64);
    EXPECT_TRUE(any(shaft, tree, {.exclude_mask = mask}));
    EXPECT_FALSE(any(shaft, tree, {.exclude = {index}, .exclude_mask = mask}));
    mask[index / 64] = ~std::uint64_t{0};
  }
}

TEST(TreeLimit, EndsSoonAfterItHasFoundEnough) {
  Random random(92);
  const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 300000);
  const BoxTree tree{std::span<const Box>(boxes)};
  const CompiledShaft shaft = compile({{-6, -6, 0}, {6, 6, 0.01F}}, {{-6, -6, 0}, {6, 6, 0.01F}});
  kernel::Counter counter(kernel::active_kernels());
  const std::size_t all = words_tested_by(counter, tree, shaft);
  for (const std::size_t most : {std::size_t{1}, std::size_t{10}, counter.result() / 10}) {
    kernel::LimitedCounter limited(kernel::active_kernels(), most);
    EXPECT_LE(words_tested_by(limited, tree, shaft), 20 + all * most / counter.result() * 2) << most << ", " << all;
    EXPECT_EQ(limited.result(), most);
  }
}

TEST(TreeLimit, CountsAndListsTheFirstOfWhatThereIs) {
  Random random(93);
  for (const Shape shape : shapes) {
    const std::vector<Box> boxes = scene<Box>(random, shape, 5000);
    const BoxTree tree{std::span<const Box>(boxes)};
    const std::vector<CompiledShaft> shafts = shafts_for(random, 20);
    std::vector<std::uint64_t> counts(shafts.size());
    IndexLists lists;
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      std::vector<std::uint32_t> all(tree.size());
      all.resize(list(shafts[s], tree, std::span(all)));
      for (const std::size_t limit :
           {std::size_t{0}, std::size_t{1}, all.size() / 2, all.size(), all.size() + 1, std::size_t{100000}}) {
        const std::size_t found = std::min(limit, all.size());
        EXPECT_EQ(count(shafts[s], tree, {.limit = limit}), found);
        count_many(shafts, tree, counts, {.limit = limit});
        EXPECT_EQ(counts[s], found);
        std::vector<std::uint32_t> some(limit + 1, 12345);
        EXPECT_EQ(list(shafts[s], tree, std::span(some).first(limit), {.limit = limit}), found);
        EXPECT_TRUE(std::equal(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(found), all.begin()));
        EXPECT_EQ(some.back(), 12345U) << "written past the room";
        const std::size_t room = limit / 2;
        std::fill(some.begin(), some.end(), 12345);
        EXPECT_EQ(list(shafts[s], tree, std::span(some).first(room), {.limit = limit}), found);
        EXPECT_TRUE(
            std::equal(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(std::min(room, found)), all.begin()));
        EXPECT_EQ(some[room], 12345U) << "written past the room";
        list_many(shafts, tree, lists, {.limit = limit});
        EXPECT_TRUE(std::ranges::equal(lists[s], std::span(all).first(found)));
      }
    }
  }
}

TEST(TreeAny, FindsNothingInAnEmptyTree) {
  const CompiledShaft shaft = compile({{-1, -1, -1}, {2, 2, 2}}, {{-1, -1, -1}, {2, 2, 2}});
  EXPECT_FALSE(any(shaft, BoxTree()));
  EXPECT_FALSE(any(shaft, SphereTree()));
}

}  // namespace
}  // namespace shaftcull
