// SPDX-License-Identifier: MIT
/// Queries about candidates (Query::only): of those of a parent shaft, its children keep the same as of all bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

template <class Bound>
class Refine : public testing::Test {};

using Kinds = testing::Types<Box, Sphere>;
TYPED_TEST_SUITE(Refine, Kinds);

/// The smallest box around both.
Box around(const Box& a, const Box& b) {
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    box.lo[k] = std::min(a.lo[k], b.lo[k]);
    box.hi[k] = std::max(a.hi[k], b.hi[k]);
  }
  return box;
}

TYPED_TEST(Refine, ChildrenKeepOfTheirParentsCandidatesWhatTheyKeepOfAll) {
  for (std::uint64_t seed = 81; seed != 91; ++seed) {
    Random random(seed);
    const auto bounds = scene<TypeParam>(random, shapes[seed % std::size(shapes)], 5000);
    const auto memory = columns(bounds);
    std::vector<Box> a;
    std::vector<Box> b;
    for (int i = 0; i != 4; ++i) {
      a.push_back(random.box(-4, -2, 0.2F, 1.0F));
      b.push_back(random.box(2, 4, 0.2F, 1.0F));
    }
    Box group_a = a[0];
    Box group_b = b[0];
    for (int i = 1; i != 4; ++i) {
      group_a = around(group_a, a[static_cast<std::size_t>(i)]);
      group_b = around(group_b, b[static_cast<std::size_t>(i)]);
    }
    const Indices candidates = FlatAnswers(compile(group_a, group_b), bounds).kept();
    std::vector<CompiledShaft> children(a.size());
    compile_batch(BoxStream(std::span<const Box>(a)).view(), BoxStream(std::span<const Box>(b)).view(), children);
    IndexLists lists;
    list_many(children, memory.view(), lists, {.only = candidates});
    for (std::size_t s = 0; s != children.size(); ++s) {
      const Indices right = FlatAnswers(children[s], bounds).kept();
      EXPECT_EQ(Indices(lists[s].begin(), lists[s].end()), right) << "seed " << seed;
      Indices kept(candidates.size());
      kept.resize(list(children[s], memory.view(), std::span(kept), {.only = candidates}));
      EXPECT_EQ(kept, right) << "seed " << seed;
      Indices in_place = candidates;
      in_place.resize(list(children[s], memory.view(), std::span(in_place), {.only = in_place}));
      EXPECT_EQ(in_place, right) << "seed " << seed;
      Indices vector = candidates;
      EXPECT_EQ(list(children[s], memory.view(), vector, {.only = vector}), right.size());
      EXPECT_EQ(vector, right) << "seed " << seed;
    }
  }
}

TYPED_TEST(Refine, CandidatesKeepTheirOrderAndMayRepeat) {
  Random random(92);
  const auto bounds = scene<TypeParam>(random, Shape::uniform, 100);
  const CompiledShaft everything = compile({{-9, -9, -9}, {9, 9, 9}}, {{-9, -9, -9}, {9, 9, 9}});
  const Indices candidates = {70, 3, 3, 99, 0};
  Indices kept(5);
  const auto memory = columns(bounds);
  EXPECT_EQ(list(everything, memory.view(), std::span(kept), {.only = candidates}), 5U);
  EXPECT_EQ(kept, candidates);
}

template <class Tree>
class TreeRefine : public testing::Test {};
TYPED_TEST_SUITE(TreeRefine, TreeKinds);

TYPED_TEST(TreeRefine, CandidatesAreTheUsersIndicesWhateverTheOrderOfTheTree) {
  using Bound = BoundOf<TypeParam>;
  Random random(93);
  std::vector<Bound> bounds = scene<Bound>(random, Shape::uniform, 5000);
  TypeParam tree{std::span<const Bound>(bounds)};
  const std::vector<CompiledShaft> shafts = shafts_for(random, 9);
  std::vector<std::uint32_t> candidates;
  for (int i = 0; i != 3000; ++i) candidates.push_back(random.below(5000));  // in no order, some twice
  const auto expect_flat_answers = [&](const char* when) {
    const auto memory = columns(bounds);
    IndexLists lists;
    list_many(shafts, tree, lists, {.only = candidates});
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      std::vector<std::uint32_t> right(candidates.size());
      right.resize(list(shafts[s], memory.view(), std::span(right), {.only = candidates}));
      std::vector<std::uint32_t> kept(candidates.size());
      kept.resize(list(shafts[s], tree, std::span(kept), {.only = candidates}));
      EXPECT_EQ(kept, right) << when;
      std::vector<std::uint32_t> in_place = candidates;
      in_place.resize(list(shafts[s], tree, std::span(in_place), {.only = in_place}));
      EXPECT_EQ(in_place, right) << when;
      EXPECT_EQ(std::vector<std::uint32_t>(lists[s].begin(), lists[s].end()), right) << when;
    }
  };
  expect_flat_answers("as built");
  const std::vector<std::uint32_t> moved = {4999, 0, 2500};
  const std::vector<Bound> values = scene<Bound>(random, Shape::clustered, moved.size());
  tree.update(moved, std::span<const Bound>(values));
  for (std::size_t i = 0; i != moved.size(); ++i) bounds[moved[i]] = values[i];
  EXPECT_THROW(static_cast<void>(list(shafts[0], tree, std::span(candidates), {.only = candidates})), NeedsRefit);
  tree.refit();
  expect_flat_answers("updated by index");
  tree.rebuild();
  expect_flat_answers("rebuilt");
}

TYPED_TEST(Refine, WhatDoesNotFitIsCountedAndNotWritten) {
  Random random(94);
  const auto bounds = scene<TypeParam>(random, Shape::uniform, 100);
  const BoundsTree<TypeParam> tree{std::span<const TypeParam>(bounds)};
  const CompiledShaft everything = compile({{-9, -9, -9}, {9, 9, 9}}, {{-9, -9, -9}, {9, 9, 9}});
  const Indices candidates = {70, 3, 99, 0};
  const auto memory = columns(bounds);
  for (std::size_t room = 0; room != 4; ++room) {
    Indices kept(5, 12345);
    Indices right(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(room));
    right.resize(5, 12345);
    EXPECT_EQ(list(everything, memory.view(), std::span(kept).first(room), {.only = candidates}), 4U);
    EXPECT_EQ(kept, right);
    EXPECT_EQ(list(everything, tree, std::span(kept).first(room), {.only = candidates}), 4U);
    EXPECT_EQ(kept, right);
  }
}

TYPED_TEST(Refine, NoCandidatesGiveNothing) {
  const auto bounds = std::vector<TypeParam>();
  const CompiledShaft shaft = compile({{0, 0, 0}, {1, 1, 1}}, {{3, 3, 3}, {4, 4, 4}});
  const auto memory = columns(bounds);
  Indices none;
  EXPECT_EQ(list(shaft, memory.view(), none, {.only = none}), 0U);
  EXPECT_EQ(list(shaft, BoundsTree<TypeParam>(), none, {.only = none}), 0U);
  IndexLists lists;
  list_many({&shaft, 1}, memory.view(), lists, {.only = none});
  EXPECT_TRUE(lists[0].empty());
  // Given and empty is not the same as not given.
  const std::vector<TypeParam> some(9, TypeParam{});
  const auto of_some = columns(some);
  const CompiledShaft everything = compile({{-9, -9, -9}, {9, 9, 9}}, {{-9, -9, -9}, {9, 9, 9}});
  EXPECT_EQ(count(everything, of_some.view(), {.only = none}), 0U);
  EXPECT_EQ(count(everything, of_some.view(), {.only = std::nullopt}), 9U);
}

}  // namespace
}  // namespace shaftcull
