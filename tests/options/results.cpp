// SPDX-License-Identifier: MIT
/// Results as ranges, numbers that a query reads, and lists into vectors.
#include "shaftcull/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "columns.hpp"
#include "message_of.hpp"
#include "options/scenes.hpp"
#include "oracle/random.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

static_assert(std::input_iterator<BitView::Iterator> && std::ranges::input_range<const BitView>);
static_assert(std::input_iterator<IndexLists::Iterator> && std::ranges::input_range<const IndexLists>);

constexpr std::uint64_t few_words[] = {0, 0b1010, 1ULL << 63, 0};
static_assert(BitView(few_words).count() == 3 && BitView(few_words)[65] && !BitView(few_words)[66]);
static_assert(*BitView(few_words).begin() == 65 && BitView().begin() == BitView().end());

TEST(BitView, OfNoWordsOrNoBitsIsEmpty) {
  for (const std::size_t size : {0U, 1U, 5U}) {
    const std::vector<std::uint64_t> words(size);
    const BitView bits(words);
    EXPECT_EQ(bits.begin(), bits.end()) << size;
    EXPECT_EQ(bits.count(), 0U) << size;
  }
  EXPECT_EQ(BitView().begin(), BitView().end());
  EXPECT_EQ(BitView().count(), 0U);
}

TEST(BitView, TellsOfEachBitAndGivesIndicesOfSetOnesAscending) {
  constexpr std::uint64_t seed = 8000;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int again = 0; again != 300; ++again) {
    std::vector<std::uint64_t> words(random.below(8));
    const unsigned share = 1 + random.below(100);
    std::vector<std::size_t> right;
    for (std::size_t i = 0; i != 64 * words.size(); ++i) {
      if (!random.one_in(share)) continue;
      words[i / 64] |= std::uint64_t{1} << i % 64;
      right.push_back(i);
    }
    const BitView bits(words);
    EXPECT_EQ(bits.count(), right.size());
    std::vector<std::size_t> walked;
    for (const std::size_t i : bits) walked.push_back(i);
    EXPECT_EQ(walked, right);
    EXPECT_EQ(std::vector<std::size_t>(bits.begin(), bits.end()), right);
    for (std::size_t i = 0; i != 64 * words.size(); ++i) {
      EXPECT_EQ(bits[i], std::binary_search(right.begin(), right.end(), i)) << i;
    }
    if (HasFailure()) return;
  }
}

TEST(BitView, StepsFromBitToBit) {
  const BitView bits(few_words);
  BitView::Iterator at = bits.begin();
  EXPECT_EQ(*at++, 65U);
  EXPECT_EQ(*at, 67U);
  BitView::Iterator copy = at;
  EXPECT_EQ(*++at, 191U);
  EXPECT_NE(copy, at);
  EXPECT_EQ(*copy, 67U);
  EXPECT_EQ(++at, bits.end());
}

TEST(BitView, ReadsTheBitsThatCullWrites) {
  Random random(8001);
  const std::vector<Box> boxes = bounds_of<Box>(random, 300);
  const CompiledShaft shaft = compile({{-5, -5, -5}, {0, 0, 0}}, {{0, 0, 0}, {5, 2, 2}});
  std::vector<std::uint64_t> kept(bit_words(boxes.size()));
  cull(shaft, BoxColumns(boxes).view(), kept);
  std::vector<std::size_t> right;
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    if (keeps(shaft, boxes[i])) right.push_back(i);
  }
  ASSERT_GT(right.size(), 10U);
  ASSERT_LT(right.size(), 290U);
  const BitView bits(kept);
  EXPECT_EQ(std::vector<std::size_t>(bits.begin(), bits.end()), right);
  EXPECT_EQ(bits.count(), right.size());
}

TEST(IndexLists, AreNoneAtFirst) {
  const IndexLists none;
  EXPECT_EQ(none.size(), 0U);
  EXPECT_EQ(none.begin(), none.end());
  const IndexLists of_no_shafts{{0}, {}};
  EXPECT_EQ(of_no_shafts.size(), 0U);
  EXPECT_EQ(of_no_shafts.begin(), of_no_shafts.end());
}

TEST(IndexLists, AreWalkedOverListByList) {
  const IndexLists lists{{0, 0, 2, 5, 5, 6, 6}, {4, 2, 9, 9, 1, 0}};
  const std::vector<Indices> right = {{}, {4, 2}, {9, 9, 1}, {}, {0}, {}};
  ASSERT_EQ(lists.size(), right.size());
  std::vector<Indices> walked;
  for (const std::span<const std::uint32_t> list : lists) walked.emplace_back(list.begin(), list.end());
  EXPECT_EQ(walked, right);
  for (std::size_t s = 0; s != right.size(); ++s) EXPECT_EQ(Indices(lists[s].begin(), lists[s].end()), right[s]) << s;

  IndexLists::Iterator at = lists.begin();
  EXPECT_TRUE((*at++).empty());
  EXPECT_EQ((*at).size(), 2U);
  EXPECT_EQ((*++at).size(), 3U);
  EXPECT_NE(at, lists.end());
  EXPECT_EQ((*at).data(), lists.indices.data() + 2) << "lists are not copied";
}

// Up to eight integers that fit go in braces.
static_assert(std::is_constructible_v<Numbers, int> && std::is_constructible_v<Numbers, std::uint32_t, std::uint8_t>);
static_assert(!std::is_constructible_v<Numbers, std::uint64_t> && !std::is_constructible_v<Numbers, int, std::int64_t>);
static_assert(!std::is_constructible_v<Numbers, bool> && !std::is_constructible_v<Numbers, double>);
static_assert(std::is_constructible_v<Numbers, int, int, int, int, int, int, int, int>);
static_assert(!std::is_constructible_v<Numbers, int, int, int, int, int, int, int, int, int>);
static_assert(std::is_convertible_v<std::uint32_t, Numbers> && std::is_convertible_v<const Indices&, Numbers>);
static_assert(!std::is_constructible_v<Numbers, const std::vector<std::uint64_t>&>);
static_assert(!std::is_constructible_v<Numbers, const char*>);

Indices values(const Numbers& numbers) { return {numbers.span().begin(), numbers.span().end()}; }

TEST(Numbers, InBracesAreCopiedWithTheQuery) {
  std::vector<Query> queries;  // which move as it grows
  for (std::uint32_t i = 0; i != 40; ++i) {
    queries.push_back({.exclude = {i, i + 1}, .layer_mask = i});
    const Query copy = queries[i / 2];
    EXPECT_EQ(values(copy.exclude), (Indices{i / 2, i / 2 + 1}));
  }
  for (std::uint32_t i = 0; i != 40; ++i) {
    EXPECT_EQ(values(queries[i].exclude), (Indices{i, i + 1}));
    EXPECT_EQ(values(queries[i].layer_mask), Indices{i});
  }
  Numbers one{1, 2, 3};
  const Numbers other = one;
  EXPECT_NE(one.span().data(), other.span().data());
  one = {};
  EXPECT_TRUE(one.span().empty());
  EXPECT_EQ(values(other), (Indices{1, 2, 3}));
  one = other;
  EXPECT_EQ(values(one), (Indices{1, 2, 3}));
  one = 5;
  EXPECT_EQ(values(one), Indices{5});
}

TEST(Numbers, AreOfAllLengthsInBraces) {
  EXPECT_TRUE(Numbers{}.span().empty());
  EXPECT_TRUE(Numbers().span().empty());
  EXPECT_EQ(values({7}), Indices{7});
  EXPECT_EQ(values({7, 0}), (Indices{7, 0}));
  EXPECT_EQ(values({1, 2, 3, 4, 5, 6, 7}), (Indices{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(values({8, 7, 6, 5, 4, 3, 2, 0xffffffff}), (Indices{8, 7, 6, 5, 4, 3, 2, 0xffffffff}));
  const std::uint32_t index = 4;
  const std::uint8_t small = 200;
  EXPECT_EQ(values({index, small, 3}), (Indices{4, 200, 3}));
}

TEST(Numbers, OfArraysAreReferredTo) {
  Indices vector(9);
  std::iota(vector.begin(), vector.end(), 0U);
  const std::array<std::uint32_t, 2> array = {3, 7};
  std::uint32_t c_array[] = {3, 7, 8};
  const Query query{.exclude = vector};
  EXPECT_EQ(query.exclude.span().data(), vector.data());
  vector[0] = 77;
  EXPECT_EQ(values(query.exclude), vector);
  EXPECT_EQ(Numbers(array).span().data(), array.data());
  EXPECT_EQ(Numbers(c_array).span().data(), c_array);
  EXPECT_EQ(Numbers(c_array).span().size(), 3U);
  EXPECT_EQ(Numbers(std::span(c_array).first(2)).span().size(), 2U);
  EXPECT_EQ(Numbers(std::span<const std::uint32_t>(vector).last(1)).span().data(), vector.data() + 8);
  EXPECT_TRUE(Numbers(Indices()).span().empty());
}

/// Returns a query with numbers in braces, which are gone when it returns.
Query stored(std::uint32_t first, std::uint32_t second) {
  return {.exclude = {first, second}, .layer_mask = {1}, .limit = 1000};
}

TEST(Numbers, InBracesStayInAStoredQuery) {
  const std::vector<Box> boxes(100, Box{{0, 0, 0}, {1, 1, 1}});
  const Indices layers(boxes.size(), 1);
  const BoxColumns memory(boxes);
  const Bounds bounds(memory.view(), layers);
  const CompiledShaft shaft = compile({{-9, -9, -9}, {9, 9, -8}}, {{-9, -9, 8}, {9, 9, 9}});
  const Query query = stored(3, 70);
  const Query another = stored(4, 5);
  Query changed = another;
  changed.exclude = {9};
  for (int again = 0; again != 2; ++again) {
    Indices kept;
    EXPECT_EQ(list(shaft, bounds, kept, query), 98U);
    EXPECT_EQ(std::count(kept.begin(), kept.end(), 3U) + std::count(kept.begin(), kept.end(), 70U), 0);
    EXPECT_EQ(list(shaft, bounds, kept, another), 98U);
    EXPECT_EQ(std::count(kept.begin(), kept.end(), 4U) + std::count(kept.begin(), kept.end(), 5U), 0);
    EXPECT_EQ(list(shaft, bounds, kept, changed), 99U);
    EXPECT_EQ(std::count(kept.begin(), kept.end(), 9U), 0);
  }
}

template <class Bound>
class VectorLists : public testing::Test {};
TYPED_TEST_SUITE(VectorLists, BoundKinds);

TYPED_TEST(VectorLists, BecomeAsLongAsTheList) {
  constexpr std::uint64_t seed = 8002;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  const Scene<TypeParam> scene(random, bounds_of<TypeParam>(random, 3000), false);
  const CompiledShaft shaft = compile({{-5, -5, -5}, {0, 0, 0}}, {{0, 0, 0}, {5, 2, 2}});
  for (const Holder& holder : scene.holders()) {
    SCOPED_TRACE(holder.name);
    Indices all;
    for (const std::uint32_t i : holder.order) {
      if (keeps(shaft, scene.bounds()[i])) all.push_back(i);
    }
    ASSERT_GT(all.size(), 300U);
    // Around the room that an empty vector gets at first.
    for (const std::size_t limit :
         {std::size_t{0}, std::size_t{1}, std::size_t{255}, std::size_t{256}, std::size_t{257}, all.size() + 1}) {
      const Indices right(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(limit, all.size())));
      for (const std::size_t size :
           {std::size_t{0}, std::size_t{1}, std::size_t{256}, right.size(), right.size() + 1, std::size_t{5000}}) {
        Indices kept(size, 7);
        EXPECT_EQ(list(shaft, holder.bounds, kept, {.limit = limit}), right.size());
        EXPECT_EQ(kept, right) << "a vector of " << size << ", limit " << limit;
        const std::uint32_t* const memory = kept.data();
        EXPECT_EQ(list(shaft, holder.bounds, kept, {.limit = limit}), right.size());
        EXPECT_EQ(kept, right) << "again";
        EXPECT_EQ(kept.data(), memory) << "allocated again";
      }
    }
    Indices kept;
    EXPECT_EQ(list(shaft, holder.bounds, kept), all.size());
    EXPECT_EQ(kept, all);
    const Indices candidates(1000, all[0]);  // more results than bounds differ
    EXPECT_EQ(list(shaft, holder.bounds, kept, {.only = candidates}), candidates.size());
    EXPECT_EQ(kept, candidates);
    EXPECT_EQ(list(shaft, holder.bounds, kept, {.only = std::span<const std::uint32_t>()}), 0U);
    EXPECT_TRUE(kept.empty());
  }
}

TEST(VectorListsOfOccluders, BecomeAsLongAsTheList) {
  const CompiledShaft shaft = compile({{-5, -1, -1}, {-4, 1, 1}}, {{4, -1, -1}, {5, 1, 1}});
  std::vector<Box> walls;  // every third one is too small
  for (int i = 0; i != 900; ++i) {
    const float x = 0.004F * static_cast<float>(i) - 2;
    const float half = i % 3 == 0 ? 0.5F : 2.0F;
    walls.push_back({{x, -half, -half}, {x + 0.001F, half, half}});
  }
  const BoxStream stream(walls);
  const BoxTree tree(stream.view());
  for (const Bounds& bounds : {Bounds(stream), Bounds(tree)}) {
    Indices all(walls.size());
    all.resize(list_occluders(shaft, bounds, std::span(all)));
    ASSERT_EQ(all.size(), 600U);
    for (const std::size_t limit : {0U, 1U, 255U, 256U, 257U, 700U}) {
      const Indices right(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(limit, all.size())));
      for (const std::size_t size : {0U, 1U, 256U, 599U, 600U, 601U, 5000U}) {
        Indices blocking(size, 7);
        EXPECT_EQ(list_occluders(shaft, bounds, blocking, {.limit = limit}), right.size());
        EXPECT_EQ(blocking, right) << "a vector of " << size << ", limit " << limit;
      }
    }
  }
  Indices blocking(3, 7);
  EXPECT_EQ(list_occluders(shaft, BoxView{}, blocking), 0U);
  EXPECT_TRUE(blocking.empty());
  blocking.assign(30, 0);
  EXPECT_EQ(message_of([&] { list_occluders(shaft, stream, blocking, {.exclude = blocking}); }),
            message_of([&] { (void)list_occluders(shaft, stream, std::span(blocking), {.exclude = blocking}); }));
  EXPECT_EQ(blocking, Indices(30, 0));
}

TYPED_TEST(VectorLists, OfNoBoundsAreEmpty) {
  Random random(8003);
  const Scene<TypeParam> scene(random, {}, false);
  const CompiledShaft shaft = compile({{-5, -5, -5}, {0, 0, 0}}, {{0, 0, 0}, {5, 2, 2}});
  for (const Holder& holder : scene.holders()) {
    Indices kept(3, 7);
    EXPECT_EQ(list(shaft, holder.bounds, kept), 0U) << holder.name;
    EXPECT_TRUE(kept.empty()) << holder.name;
  }
}

}  // namespace
}  // namespace shaftcull
