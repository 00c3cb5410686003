// SPDX-License-Identifier: MIT
/// What trees refuse, and what they say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "float_modes.hpp"
#include "message_of.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "tree/scenes.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

const CompiledShaft& shaft() {
  static const CompiledShaft compiled = compile({{0, 0, 0}, {1, 1, 1}}, {{3, 3, 3}, {4, 4, 4}});
  return compiled;
}

std::vector<Box> boxes(std::size_t count) {
  Random random(1);
  return scene<Box>(random, Shape::uniform, count);
}

#ifdef SHAFTCULL_HAS_FLOAT_MODES
TEST(TreeErrors, BadBoundsAreBadInEveryMode) {
  const std::vector<Box> bad = {{{0, 0, 0}, {1, 1, 1}},
                                {{1e-40F, 0, 0}, {0, 1, 1}}};  // lo > hi, unless denormals are zero
  const std::vector<Box> good = {{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}};
  for (const Mode& mode : modes) {
    const InMode in(mode);
    EXPECT_THROW(BoxTree{std::span<const Box>(bad)}, BadBound) << mode.name;
    BoxTree tree{std::span<const Box>(good)};
    EXPECT_THROW(tree.update(std::span<const Box>(bad)), BadBound) << mode.name;
  }
}
#endif

TEST(TreeErrors, TheFirstBadBoundIsNamed) {
  std::vector<Box> bad = boxes(40000);
  bad[39000].lo[2] = 100;
  bad[20001].hi[1] = NAN;
  for (const bool streams : {false, true}) {
    const auto build = [&] {
      if (streams) {
        const BoxTree tree(columns(bad).view());
      } else {
        const BoxTree tree{std::span<const Box>(bad)};
      }
    };
    const auto error = caught<BadBound>(build);
    ASSERT_TRUE(error);
    EXPECT_THAT(error->what(), HasSubstr("box 20001: hi.y is not a number"));
    EXPECT_EQ(error->index(), 20001U);
  }
  const std::vector<Sphere> spheres = {{{0, 0, 0}, 1}, {{0, 0, 0}, -2}};
  EXPECT_THAT(message_of([&] { const SphereTree tree{std::span<const Sphere>(spheres)}; }),
              HasSubstr("sphere 1: radius = -2 is negative"));
}

#if SIZE_MAX > UINT32_MAX
TEST(TreeErrors, MoreBoundsThanIndicesReachAreRefused) {
  BoxView view = BoxStream(std::span<const Box>(boxes(1))).view();
  const auto refusal_of = [&]<class Tree>(std::size_t count, const Tree& /*kind*/) {
    view.count = count;  // never read
    return message_of([&] { const Tree tree(view); });
  };
  EXPECT_THAT(refusal_of(std::size_t{1} << 32U, BoxTree()),
              HasSubstr("a tree of 4294967296 bounds: one can hold 4294967295; build several"));
}
#endif

TEST(TreeErrors, ABadUpdateLeavesTheTreeAsItWas) {
  BoxTree tree{std::span<const Box>(boxes(100))};
  std::vector<Box> bad = boxes(100);
  bad[7].lo[0] = NAN;
  EXPECT_THAT(message_of([&] { tree.update(std::span<const Box>(bad)); }), HasSubstr("box 7"));
  const std::vector<std::uint32_t> indices = {50, 51};
  EXPECT_THAT(message_of([&] { tree.update(indices, std::span<const Box>(bad).subspan(6, 2)); }),
              HasSubstr("box 1: lo.x"));
  EXPECT_FALSE(tree.needs_refit());
  const std::vector<Box> before = boxes(100);
  for (std::size_t p = 0; p != 100; ++p) EXPECT_EQ(tree.leaves()[p], before[tree.order()[p]]);
}

TEST(TreeErrors, SizesAndIndicesMustFit) {
  BoxTree tree{std::span<const Box>(boxes(100))};
  const std::vector<Box> some = boxes(3);
  EXPECT_THAT(message_of([&] { tree.update(std::span<const Box>(some)); }), HasSubstr("a tree of 100 bounds got 3"));
  BoxTree one{std::span<const Box>(boxes(1))};
  EXPECT_THAT(message_of([&] { one.update(std::span<const Box>(some)); }), HasSubstr("a tree of 1 bound got 3"));
  std::vector<std::uint32_t> indices = {1, 2};
  EXPECT_THAT(message_of([&] { tree.update(indices, std::span<const Box>(some)); }),
              HasSubstr("2 indices and 3 bounds"));
  indices = {1};
  EXPECT_THAT(message_of([&] { tree.update(indices, std::span<const Box>(some)); }), HasSubstr("1 index and 3 bounds"));
  indices = {1, 100, 2};
  EXPECT_THAT(message_of([&] { tree.update(indices, std::span<const Box>(some)); }),
              HasSubstr("indices[1] = 100 is not below the number of bounds, 100"));
}

TEST(TreeErrors, QueriesOfAnUpdatedTreeAskForARefit) {
  for (const std::size_t count : {10U, 10000U}) {
    BoxTree tree{std::span<const Box>(boxes(count))};
    const std::vector<std::uint32_t> indices = {3};
    tree.update(indices, std::span<const Box>(boxes(1)));
    EXPECT_THAT(message_of<NeedsRefit>([&] { static_cast<void>(shaftcull::count(shaft(), tree)); }),
                HasSubstr("call refit() first"));
    EXPECT_THAT(message_of<NeedsRefit>([&] { static_cast<void>(tree.sah_ratio()); }), HasSubstr("call refit() first"));
    tree.refit();
    EXPECT_NO_THROW(static_cast<void>(shaftcull::count(shaft(), tree)));
  }
}

TEST(TreeErrors, ExclusionsAndCountsMustFit) {
  const BoxTree tree{std::span<const Box>(boxes(100))};
  const std::vector<CompiledShaft> shafts(2, shaft());
  const std::vector<std::uint32_t> three = {1, 2, 3};
  const std::vector<std::uint64_t> one_word(1);
  std::vector<std::uint64_t> counts(2);
  EXPECT_THAT(message_of([&] { count_many(shafts, tree, counts, {.exclude_each = three}); }),
              HasSubstr("query.exclude_each has 3 indices, which is not a multiple of the 2 shafts"));
  EXPECT_THAT(message_of([&] { count_many(shafts, tree, counts, {.exclude_mask = one_word}); }),
              HasSubstr("query.exclude_mask has 1 word; the bits of 100 bounds take 2"));
  counts.resize(3);
  EXPECT_THAT(message_of([&] { count_many(shafts, tree, counts); }), HasSubstr("kept_counts has room for 3; 2 shafts"));
  std::vector<KeptCounts> classified(1);
  EXPECT_THAT(message_of([&] { count_classified_many(shafts, tree, classified); }),
              HasSubstr("counts has room for 1; 2 shafts"));
}

TEST(TreeErrors, BitsMustFit) {
  const BoxTree tree{std::span<const Box>(boxes(100))};
  const std::vector<CompiledShaft> shafts(2, shaft());
  const std::vector<std::uint64_t> untouched(4, 7);
  std::vector<std::uint64_t> words = untouched;
  const std::span<std::uint64_t> all(words);
  EXPECT_THAT(message_of([&] { cull(shaft(), tree, all.first(1)); }),
              HasSubstr("kept has 1 word; the answers of 100 bounds take 2"));
  EXPECT_THAT(message_of([&] { classify(shaft(), tree, all.first(2), all.first(3)); }),
              HasSubstr("inside has 3 words; the answers of 100 bounds take 2"));
  EXPECT_THAT(message_of([&] { classify(shaft(), tree, all.first(2), all.subspan(1, 2)); }),
              HasSubstr("classify: kept and inside share memory"));
  EXPECT_THAT(message_of([&] { classify(shaft(), tree, {}, all.first(1)); }), HasSubstr("inside has 1 word"));
  EXPECT_THAT(message_of([&] { cull_many(shafts, tree, all.first(3)); }), HasSubstr("kept_rows has 3 words"));
  EXPECT_THAT(message_of([&] { classify_many(shafts, tree, all, all); }),
              HasSubstr("classify_many: kept_rows and inside_rows share memory"));
  EXPECT_THAT(message_of([&] { classify_many(shafts, tree, {}, all.first(3)); }), HasSubstr("inside_rows has 3 words"));
  EXPECT_THAT(message_of([&] { any_many(shafts, tree, all.first(2)); }),
              HasSubstr("any has 2 words; one bit for each of 2 shafts takes 1"));
  EXPECT_THAT(message_of([&] { cull(shaft(), tree, all.first(2), {.exclude_mask = all.subspan(1, 2)}); }),
              HasSubstr("cull: kept and query.exclude_mask share memory"));
  EXPECT_THAT(message_of([&] { any_many(shafts, tree, all.first(1), {.exclude_mask = all.first(2)}); }),
              HasSubstr("any_many: any and query.exclude_mask share memory"));
  EXPECT_THAT(message_of([&] { cull(CompiledShaft(), tree, all.first(2)); }), HasSubstr("shaft 0 was never formed"));
  EXPECT_EQ(words, untouched);
}

TEST(TreeErrors, NoOutputsAreUnambiguous) {
  cull(shaft(), BoxTree(), {});
  classify(shaft(), BoxTree(), {}, {});
  classify_many({}, BoxTree(), {}, {});
  cull_many({}, BoxTree(), {});
  any_many({}, BoxTree(), {});
}

TEST(TreeErrors, CandidatesMustExistAndFit) {
  const auto memory = columns(boxes(100));
  std::vector<std::uint32_t> candidates = {4, 99, 100};
  std::vector<std::uint32_t> kept(3);
  EXPECT_THAT(
      message_of([&] { static_cast<void>(list(shaft(), memory.view(), std::span(kept), {.only = candidates})); }),
      HasSubstr("query.only[2] = 100 is not below the number of bounds, 100"));
  IndexLists lists;
  EXPECT_THAT(message_of([&] {
                list_many({&shaft(), 1}, memory.view(), lists, {.only = candidates});
              }),
              HasSubstr("query.only[2] = 100 is not below the number of bounds, 100"));
  const BoxTree tree(memory.view());
  EXPECT_THAT(message_of([&] { static_cast<void>(list(shaft(), tree, std::span(kept), {.only = candidates})); }),
              HasSubstr("query.only[2] = 100 is not below the number of bounds, 100"));
  EXPECT_THAT(message_of([&] {
                list_many({&shaft(), 1}, tree, lists, {.only = candidates});
              }),
              HasSubstr("query.only[2] = 100 is not below the number of bounds, 100"));
}

}  // namespace
}  // namespace shaftcull
