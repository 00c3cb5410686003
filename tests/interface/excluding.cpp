// SPDX-License-Identifier: MIT
/// What a query leaves out can be written in the call, in every way in which indices come.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "caught.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

template <class Index>
class Excluded : public testing::Test {
 protected:
  static constexpr std::size_t size = 100;  // all in the shaft

  const CompiledShaft shaft_ = compile({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 9}, {1, 1, 10}});
  const BoundsTree<Box, Index> tree_{std::vector<Box>(size, Box{{0, 0, 5}, {1, 1, 6}})};
};
using Indices = testing::Types<std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(Excluded, Indices);

TYPED_TEST(Excluded, IndicesMayBeInBraces) {
  std::array<std::uint64_t, words_for(Excluded<TypeParam>::size)> kept;
  cull(this->shaft_, this->tree_, kept, {.own = {3, 7}});
  EXPECT_EQ(kept[0], ~(std::uint64_t{1} << 3 | std::uint64_t{1} << 7));
  EXPECT_EQ(count(this->shaft_, this->tree_, {.own = {3, 7, 99}}), this->size - 3);
  EXPECT_EQ(count(this->shaft_, this->tree_, {.own = {42}}), this->size - 1);
  EXPECT_EQ(count(this->shaft_, this->tree_, {.own = {}}), this->size);
  EXPECT_EQ(count(this->shaft_, this->tree_, {}), this->size);
}

TYPED_TEST(Excluded, BracesHoldARowForEachOfManyShafts) {
  const std::vector<CompiledShaft> shafts(2, this->shaft_);
  IndexListsOf<TypeParam> lists;
  list_many(shafts, this->tree_, lists, {.own = {3, 7, 8, 9}});
  ASSERT_EQ(lists.size(), 2U);
  const auto has = [&](std::size_t shaft, TypeParam index) {
    return std::find(lists[shaft].begin(), lists[shaft].end(), index) != lists[shaft].end();
  };
  for (const TypeParam index : std::vector<TypeParam>{3, 7, 8, 9}) {
    EXPECT_EQ(has(0, index), index >= 8) << index;
    EXPECT_EQ(has(1, index), index < 8) << index;
  }
}

TYPED_TEST(Excluded, IndicesMayBeAVectorAnArrayASpanOrAPointerAndASize) {
  const std::vector<TypeParam> vector = {3, 7};
  const std::array<TypeParam, 2> array = {3, 7};
  TypeParam c_array[] = {3, 7};
  const auto count_without = [&](const ExcludingOf<TypeParam>& excluding) {
    return count(this->shaft_, this->tree_, excluding);
  };
  EXPECT_EQ(count_without({.own = vector}), this->size - 2);
  EXPECT_EQ(count_without({.own = array}), this->size - 2);
  EXPECT_EQ(count_without({.own = c_array}), this->size - 2);
  EXPECT_EQ(count_without({.own = std::span(c_array)}), this->size - 2);
  EXPECT_EQ(count_without({.own = std::span<TypeParam>(c_array)}), this->size - 2);
  EXPECT_EQ(count_without({.own = std::span<const TypeParam>(vector).first(1)}), this->size - 1);
  EXPECT_EQ(count_without({.own = {vector.data(), 1}}), this->size - 1);
  EXPECT_EQ(count_without({.own = {vector.begin(), vector.end()}}), this->size - 2);
}

TYPED_TEST(Excluded, BracesGoWithAMask) {
  const std::vector<std::uint64_t> mask = {1, 0};  // bound 0
  EXPECT_EQ(count(this->shaft_, this->tree_, {.own = {3, 7}, .mask = mask}), this->size - 3);
}

TYPED_TEST(Excluded, IndicesInBracesAreChecked) {
  EXPECT_THROW(static_cast<void>(count(this->shaft_, this->tree_, {.own = {3, 100}})), InvalidArgument);
}

}  // namespace
}  // namespace shaftcull
