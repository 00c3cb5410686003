// SPDX-License-Identifier: MIT
/// Trees of solid boxes: what blocks a shaft, and how little of a tree is looked at for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "dispatch/active_kernels.hpp"
#include "message_of.hpp"
#include "sanitizers.hpp"
#include "shaftcull/occluded.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/tree_access.hpp"
#include "tree/walked.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

std::size_t occluder_words_tested = 0;
kernel::OcclusionKernels real{};

void count_leaves(const kernel::ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                  std::size_t words, std::uint64_t* blocking, std::uint64_t* inside, unsigned least) noexcept {
  occluder_words_tested += words;
  real.listed_boxes(shaft, stream, word, words, blocking, inside, least);
}
void count_nodes(const kernel::ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                 std::size_t words, std::uint64_t* blocking, std::uint64_t* inside, unsigned least) noexcept {
  occluder_words_tested += words;
  real.listed_nodes(shaft, stream, word, words, blocking, inside, least);
}

/// Words of leaves and nodes that are tested to find out whether the shaft is occluded.
std::size_t words_tested_for(const BoxTree& tree, const CompiledShaft& shaft) {
  kernel::Kernels kernels = kernel::active_kernels();
  real = kernels.blocking;
  kernels.blocking.listed_boxes = count_leaves;
  kernels.blocking.listed_nodes = count_nodes;
  occluder_words_tested = 0;
  kernel::Finder finder;
  walk(*TreeAccess::parts(tree), kernels, shaft, kernel::Question::blocking, finder);
  return occluder_words_tested;
}

/// Some of the boxes large, so that some block.
std::vector<Box> solids(Random& random, Shape shape, std::size_t count) {
  std::vector<Box> boxes = scene<Box>(random, shape, count);
  for (std::size_t i = 0; i < count; i += 1 + random.below(static_cast<unsigned>(count))) {
    boxes[i] = random.one_in(2) ? random.box(-3, 3, 0.5F, 3.0F) : random.grid_box(-5, 5);
  }
  return boxes;
}

/// Shafts between boxes, thin and thick, flat and on a grid.
std::vector<CompiledShaft> shafts_between(Random& random, std::size_t count) {
  std::vector<CompiledShaft> shafts;
  while (shafts.size() != count) {
    const auto end = [&] {
      if (random.one_in(3)) return random.grid_box(-5, 5);
      return random.one_in(2) ? random.box(-5, 5, 0, 0.1F) : random.box(-5, 5, 0.2F, 1.0F);
    };
    const Box a = end();
    shafts.push_back(compile(a, end()));
  }
  return shafts;
}

TEST(TreeOccluded, SaysWhatAFlatScanSays) {
  std::size_t occluded_ones = 0;
  std::size_t all = 0;
  for (std::uint64_t seed = 800; seed != 800 + random_cases(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Shape shape = shapes[random.below(std::size(shapes))];
    const std::size_t count = random.one_in(20) ? 1 + random.below(9000) : 1 + random.below(300);
    const std::vector<Box> boxes = solids(random, shape, count);
    const BoxColumns memory(boxes);
    const BoxTree tree{std::span<const Box>(boxes)};
    const std::vector<CompiledShaft> shafts = shafts_between(random, 70);
    std::vector<std::uint64_t> expected(2, 0x5555);
    occluded_many(shafts, memory.view(), expected);
    IndexLists lists;
    list_occluders_many(shafts, tree, lists);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      const bool right = occluded(shafts[s], memory.view());
      EXPECT_EQ((expected[s / 64] >> s % 64 & 1U) != 0, right);
      EXPECT_EQ(occluded(shafts[s], tree), right);
      std::vector<std::uint32_t> flat(boxes.size());
      flat.resize(list_occluders(shafts[s], memory.view(), flat));
      std::vector<std::uint32_t> listed(boxes.size());
      listed.resize(list_occluders(shafts[s], tree, listed));
      EXPECT_EQ(sorted(listed), flat);
      EXPECT_EQ(find_occluder(shafts[s], tree), right ? std::optional(listed[0]) : std::nullopt);
      EXPECT_EQ(std::vector<std::uint32_t>(lists[s].begin(), lists[s].end()), listed);
      occluded_ones += right ? 1U : 0U;
      ++all;
    }
    std::vector<std::uint64_t> bits(2, 0x5555);
    occluded_many(shafts, tree, bits);
    EXPECT_EQ(bits, expected);
    if (HasFailure()) return;
  }
  EXPECT_TRUE(occluded_ones > all / 50 && occluded_ones < all) << occluded_ones << " of " << all;
}

/// A flat box in the plane of the shaft blocks it, though no node around it holds it in its interior.
TEST(TreeOccluded, FindsAFlatBoxInThePlaneOfAFlatShaft) {
  std::vector<Box> boxes(5000, Box{{0, 0, 7}, {1, 1, 8}});
  boxes[77] = {{4, -5, 0}, {5, 5, 0}};
  const BoxTree tree{std::span<const Box>(boxes)};
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 0}}, Box{{9, 0, 0}, {9, 1, 0}});
  EXPECT_TRUE(occluded(shaft, tree));
  EXPECT_FALSE(occluded(shaft, tree, {.exclude = {77}}));
}

TEST(TreeOccluded, LooksIntoNodesOnlyThatEverySegmentPassesThrough) {
  Random random(801);
  std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 300000);
  const CompiledShaft wide = compile(Box{{-6, -6, -6}, {6, 6, -6}}, Box{{-6, -6, 6}, {6, 6, 6}});
  const BoxTree tree{std::span<const Box>(boxes)};
  EXPECT_FALSE(occluded(wide, tree));
  EXPECT_LE(words_tested_for(tree, wide), 5U) << "though all boxes are inside it";
  boxes.push_back({{-9, -9, 0}, {9, 9, 0.1F}});
  const BoxTree with_wall{std::span<const Box>(boxes)};
  EXPECT_TRUE(occluded(wide, with_wall));
  EXPECT_LE(words_tested_for(with_wall, wide), 8U);
}

TEST(TreeOccluded, LeavesOutWhatIsExcluded) {
  const Box wall{{2, -9, -9}, {3, 9, 9}};
  const std::vector<Box> boxes(5000, wall);
  const BoxTree tree{std::span<const Box>(boxes)};
  const std::vector<CompiledShaft> shafts(3, compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}}));
  std::vector<std::uint64_t> mask(bit_words(boxes.size()), ~std::uint64_t{0});
  EXPECT_TRUE(occluded(shafts[0], tree));
  EXPECT_FALSE(occluded(shafts[0], tree, {.exclude_mask = mask}));
  EXPECT_EQ(find_occluder(shafts[0], tree, {.exclude_mask = mask}), std::nullopt);
  mask[4999 / 64] &= ~(std::uint64_t{1} << 4999 % 64);
  EXPECT_TRUE(occluded(shafts[0], tree, {.exclude_mask = mask}));
  EXPECT_EQ(find_occluder(shafts[0], tree, {.exclude_mask = mask}), 4999U);
  std::vector<std::uint64_t> bits(1);
  const std::vector<std::uint32_t> last_walls = {1, 4999, 2};
  occluded_many(shafts, tree, bits, {.exclude_each = last_walls, .exclude_mask = mask});
  EXPECT_EQ(bits[0], 0b101U) << "the second shaft leaves out the last wall";
  occluded_many(shafts, tree, bits, {.exclude = {4999}, .exclude_mask = mask});
  EXPECT_EQ(bits[0], 0U) << "all shafts leave it out";
}

TEST(TreeOccluded, NothingBlocksInAnEmptyTree) {
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}});
  EXPECT_FALSE(occluded(shaft, BoxTree()));
  std::vector<std::uint64_t> bits(1, 7);
  occluded_many({&shaft, 1}, BoxTree(), bits);
  EXPECT_EQ(bits[0], 0U);
}

TEST(TreeOccluded, WhatDoesNotFitIsRefusedBeforeAnythingIsWritten) {
  const std::vector<Box> boxes(300, Box{{2, -9, -9}, {3, 9, 9}});
  BoxTree tree{std::span<const Box>(boxes)};
  const std::vector<CompiledShaft> shafts(3, compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}}));
  std::vector<std::uint64_t> bits(5, 7);
  EXPECT_THAT(message_of([&] { occluded_many(shafts, tree, bits); }),
              testing::AllOf(HasSubstr("occluded has 5 words"), HasSubstr("3 shafts")));
  EXPECT_THAT(message_of([&] { occluded_many(shafts, tree, std::span(bits).first(1), {.exclude_mask = bits}); }),
              HasSubstr("occluded and query.exclude_mask share memory"));
  tree.update(std::vector<std::uint32_t>{1}, std::span<const Box>(boxes).first(1));
  EXPECT_THROW((void)occluded(shafts[0], tree), NeedsRefit);
  EXPECT_THROW(occluded_many(shafts, tree, std::span(bits).first(1)), NeedsRefit);
  EXPECT_THROW((void)find_occluder(shafts[0], tree), NeedsRefit);
  IndexLists lists;
  EXPECT_THROW(list_occluders_many(shafts, tree, lists), NeedsRefit);
  EXPECT_EQ(bits, std::vector<std::uint64_t>(5, 7));
}

}  // namespace
}  // namespace shaftcull
