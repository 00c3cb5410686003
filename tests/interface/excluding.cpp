// SPDX-License-Identifier: MIT
/// Options of a query can be written in the call, in every way in which numbers come, whatever holds the bounds.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "caught.hpp"
#include "message_of.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

class Excluded : public testing::Test {
 protected:
  static constexpr std::size_t size = 100;  // all in the shaft

  [[nodiscard]] std::vector<Bounds> all() const {
    return {boxes_.view(),     boxes_,     box_tree_,     spheres_.view(), spheres_, sphere_tree_,
            triangles_.view(), triangles_, triangle_tree_};
  }

  const CompiledShaft shaft_ = compile({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 9}, {1, 1, 10}});
  const std::vector<CompiledShaft> shafts_ = {shaft_, shaft_};
  const BoxStream boxes_{std::vector<Box>(size, Box{{0, 0, 5}, {1, 1, 6}})};
  const BoxTree box_tree_{boxes_};
  const SphereStream spheres_{std::vector<Sphere>(size, Sphere{{0.5F, 0.5F, 5}, 1})};
  const SphereTree sphere_tree_{spheres_};
  const TriangleStream triangles_{std::vector<Triangle>(size, Triangle{{{{0, 0, 5}, {1, 0, 5}, {0, 1, 6}}}})};
  const TriangleTree triangle_tree_{triangles_};
};

TEST_F(Excluded, IndicesMayBeInBraces) {
  for (const Bounds& bounds : all()) {
    std::array<std::uint64_t, bit_words(size)> kept;
    cull(shaft_, bounds, kept, {.exclude = {3, 7}});
    EXPECT_EQ(kept[0], ~(std::uint64_t{1} << 3 | std::uint64_t{1} << 7));
    EXPECT_EQ(count(shaft_, bounds, {.exclude = {3, 7, 99}}), size - 3);
    EXPECT_EQ(count(shaft_, bounds, {.exclude = {42}}), size - 1);
    EXPECT_EQ(count(shaft_, bounds, {.exclude = {0, 1, 2, 3, 4, 5, 6, 7}}), size - Numbers::most_in_braces);
    EXPECT_EQ(count(shaft_, bounds, {.exclude = {}}), size);
    EXPECT_EQ(count(shaft_, bounds, {}), size);
  }
}

TEST_F(Excluded, IndicesInBracesAreKeptByTheQuery) {
  Query query{.exclude = {3, 7}};
  const Query copy = query;
  EXPECT_EQ(count(shaft_, box_tree_, query), size - 2);
  query = {.exclude = {1}};
  EXPECT_EQ(count(shaft_, box_tree_, query), size - 1);
  EXPECT_EQ(count(shaft_, box_tree_, copy), size - 2);
}

TEST_F(Excluded, IndicesAreThoseOfAllShafts) {
  for (const Bounds& bounds : all()) {
    IndexLists lists;
    list_many(shafts_, bounds, lists, {.exclude = {3, 7, 8}});
    ASSERT_EQ(lists.size(), 2U);
    for (const std::span<const std::uint32_t> kept : lists) {
      EXPECT_EQ(kept.size(), size - 3);
      for (const std::uint32_t index : {3U, 7U, 8U}) {
        EXPECT_THAT(std::vector(kept.begin(), kept.end()), testing::Not(testing::Contains(index)));
      }
    }
  }
}

TEST_F(Excluded, ARowForEachOfManyShaftsIsItsOwn) {
  const std::array<std::uint32_t, 4> rows = {3, 7, 8, 9};
  for (const Bounds& bounds : all()) {
    IndexLists lists;
    list_many(shafts_, bounds, lists, {.exclude = {50}, .exclude_each = rows});
    ASSERT_EQ(lists.size(), 2U);
    for (std::size_t shaft = 0; shaft != lists.size(); ++shaft) {
      const std::vector<std::uint32_t> kept(lists[shaft].begin(), lists[shaft].end());
      EXPECT_EQ(kept.size(), size - 3);
      EXPECT_THAT(kept, testing::Not(testing::Contains(50U)));
      for (std::size_t i = 0; i != rows.size(); ++i) {
        EXPECT_EQ(std::find(kept.begin(), kept.end(), rows[i]) == kept.end(), i / 2 == shaft) << rows[i];
      }
    }
  }
}

TEST_F(Excluded, ARowOfOneShaftIsAllOfThem) {
  const std::vector<std::uint32_t> row = {3, 7};
  for (const Bounds& bounds : all()) {
    EXPECT_EQ(count(shaft_, bounds, {.exclude_each = row}), size - 2);
    EXPECT_EQ(count(shaft_, bounds, {.exclude = {7, 8}, .exclude_each = row}), size - 3);
  }
}

TEST_F(Excluded, IndicesMayBeAVectorAnArrayOrASpan) {
  const std::vector<std::uint32_t> vector = {3, 7};
  const std::array<std::uint32_t, 2> array = {3, 7};
  std::uint32_t c_array[] = {3, 7};
  const auto count_without = [&](const Query& query) { return count(shaft_, box_tree_, query); };
  EXPECT_EQ(count_without({.exclude = vector}), size - 2);
  EXPECT_EQ(count_without({.exclude = {vector}}), size - 2);
  EXPECT_EQ(count_without({.exclude = array}), size - 2);
  EXPECT_EQ(count_without({.exclude = c_array}), size - 2);
  EXPECT_EQ(count_without({.exclude = std::span(c_array)}), size - 2);
  EXPECT_EQ(count_without({.exclude = std::span<std::uint32_t>(c_array)}), size - 2);
  EXPECT_EQ(count_without({.exclude = std::span<const std::uint32_t>(vector).first(1)}), size - 1);
  EXPECT_EQ(count_without({.exclude_each = vector}), size - 2);
  EXPECT_EQ(count_without({.exclude_each = array}), size - 2);
}

TEST_F(Excluded, BracesGoWithAMask) {
  const std::vector<std::uint64_t> mask = {1, 0};  // bound 0
  for (const Bounds& bounds : all()) {
    EXPECT_EQ(count(shaft_, bounds, {.exclude = {3, 7}, .exclude_mask = mask}), size - 3);
  }
}

TEST_F(Excluded, LayersMayBeInBraces) {
  std::vector<std::uint32_t> layers(size, 1);
  layers[3] = 2;
  layers[7] = 6;
  std::vector<std::uint64_t> counts(shafts_.size());
  for (const Bounds& bounds : {Bounds(boxes_.view(), layers), Bounds(spheres_, layers), Bounds(triangles_, layers)}) {
    EXPECT_EQ(count(shaft_, bounds, {.layer_mask = {2}}), 2U);
    EXPECT_EQ(count(shaft_, bounds, {.layer_mask = {0b101}}), size - 1);
    EXPECT_EQ(count(shaft_, bounds, {.exclude = {3}, .layer_mask = {2}}), 1U);
    count_many(shafts_, bounds, counts, {.layer_mask = {2, 4}});
    EXPECT_THAT(counts, testing::ElementsAre(2, 1));
  }
}

TEST_F(Excluded, IndicesAreChecked) {
  for (const Bounds& bounds : all()) {
    EXPECT_THROW(static_cast<void>(count(shaft_, bounds, {.exclude = {3, 100}})), InvalidArgument);
    const std::vector<std::uint32_t> row = {3, 100};
    EXPECT_THROW(static_cast<void>(count(shaft_, bounds, {.exclude_each = row})), InvalidArgument);
    const std::vector<std::uint32_t> three = {3, 7, 8};  // no rows of two shafts
    std::vector<std::uint64_t> counts(shafts_.size());
    EXPECT_THROW(count_many(shafts_, bounds, counts, {.exclude_each = three}), InvalidArgument);
  }
}

/// An option that means nothing to a call is refused, and the message names it.
class RefusedOption : public Excluded {
 protected:
  template <class Call>
  static void expect_named(const Call& call, const char* option) {
    EXPECT_THAT(message_of(call), testing::HasSubstr(option));
  }

  const Query limited_{.limit = 1};
};

TEST_F(RefusedOption, LimitOfAVerbThatNeitherCountsNorListsKeptBounds) {
  std::array<std::uint64_t, 2 * bit_words(size)> kept;
  std::array<std::uint64_t, 2 * bit_words(size)> inside;
  std::array<std::uint32_t, size> overlap_list;
  std::array<std::uint32_t, size> inside_list;
  std::array<KeptCounts, 2> counts;
  IndexLists lists;
  IndexLists others;
  const std::span<std::uint64_t> one = std::span(kept).first(bit_words(size));
  const std::span<std::uint64_t> other = std::span(inside).first(bit_words(size));
  for (const Bounds& bounds : all()) {
    expect_named([&] { cull(shaft_, bounds, one, limited_); }, "limit");
    expect_named([&] { classify(shaft_, bounds, one, other, limited_); }, "limit");
    expect_named([&] { (void)any(shaft_, bounds, limited_); }, "limit");
    expect_named([&] { (void)count_classified(shaft_, bounds, limited_); }, "limit");
    expect_named([&] { (void)list_classified(shaft_, bounds, overlap_list, inside_list, limited_); }, "limit");
    expect_named([&] { cull_many(shafts_, bounds, kept, limited_); }, "limit");
    expect_named([&] { classify_many(shafts_, bounds, kept, inside, limited_); }, "limit");
    expect_named([&] { any_many(shafts_, bounds, std::span(kept).first(1), limited_); }, "limit");
    expect_named([&] { count_classified_many(shafts_, bounds, counts, limited_); }, "limit");
    expect_named([&] { list_classified_many(shafts_, bounds, lists, others, limited_); }, "limit");
  }
}

TEST_F(RefusedOption, LimitOfContactsAndOfWhetherABoxBlocks) {
  std::array<FirstContact, 2> contacts;
  std::array<std::uint64_t, 1> bits;
  for (const Bounds& bounds : {Bounds(boxes_), Bounds(box_tree_)}) {
    expect_named([&] { (void)first_contact(shaft_, bounds, limited_); }, "limit");
    expect_named([&] { first_contact_many(shafts_, bounds, contacts, limited_); }, "limit");
    expect_named([&] { (void)occluded(shaft_, bounds, limited_); }, "limit");
    expect_named([&] { (void)find_occluder(shaft_, bounds, limited_); }, "limit");
    expect_named([&] { occluded_many(shafts_, bounds, bits, limited_); }, "limit");
  }
}

TEST_F(RefusedOption, OnlyOfWhatBlocks) {
  const std::array<std::uint32_t, 1> candidates = {0};
  const Query query{.only = candidates};
  std::array<std::uint64_t, 1> bits;
  std::array<std::uint32_t, size> room;
  IndexLists lists;
  for (const Bounds& bounds : {Bounds(boxes_), Bounds(box_tree_)}) {
    expect_named([&] { (void)occluded(shaft_, bounds, query); }, "only");
    expect_named([&] { (void)find_occluder(shaft_, bounds, query); }, "only");
    expect_named([&] { (void)list_occluders(shaft_, bounds, room, query); }, "only");
    expect_named([&] { occluded_many(shafts_, bounds, bits, query); }, "only");
    expect_named([&] { list_occluders_many(shafts_, bounds, lists, query); }, "only");
  }
}

TEST_F(RefusedOption, TriangleTestOfOtherBounds) {
  const Query query{.triangle_test = TriangleTest::vertices};
  for (const Bounds& bounds : {Bounds(boxes_), Bounds(box_tree_), Bounds(spheres_), Bounds(sphere_tree_)}) {
    expect_named([&] { (void)count(shaft_, bounds, query); }, "triangle_test");
    EXPECT_EQ(count(shaft_, bounds, {.triangle_test = TriangleTest::exact}), size);
  }
}

TEST_F(RefusedOption, LayerMaskOfBoundsWithoutLayers) {
  for (const Bounds& bounds : all()) {
    expect_named([&] { (void)any(shaft_, bounds, {.layer_mask = {1}}); }, "layer_mask");
  }
}

/// Up to eight numbers go into braces.
template <std::size_t... I>
constexpr bool goes_into_braces(std::index_sequence<I...> /*numbers*/) {
  return requires { Numbers{static_cast<std::uint32_t>(I)...}; };
}
static_assert(goes_into_braces(std::make_index_sequence<Numbers::most_in_braces>()));
static_assert(!std::constructible_from<Numbers, int, int, int, int, int, int, int, int, int>);
static_assert(!std::constructible_from<Numbers, std::vector<std::uint64_t>> &&
              !std::constructible_from<Numbers, float*>);

}  // namespace
}  // namespace shaftcull
