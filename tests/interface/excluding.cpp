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

class Excluded : public testing::Test {
 protected:
  static constexpr std::size_t size = 100;  // all in the shaft

  const CompiledShaft shaft_ = compile({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 9}, {1, 1, 10}});
  const BoundsTree<Box> tree_{std::vector<Box>(size, Box{{0, 0, 5}, {1, 1, 6}})};
};
TEST_F(Excluded, IndicesMayBeInBraces) {
  std::array<std::uint64_t, words_for(size)> kept;
  cull(shaft_, tree_, kept, {.own = {3, 7}});
  EXPECT_EQ(kept[0], ~(std::uint64_t{1} << 3 | std::uint64_t{1} << 7));
  EXPECT_EQ(count(shaft_, tree_, {.own = {3, 7, 99}}), size - 3);
  EXPECT_EQ(count(shaft_, tree_, {.own = {42}}), size - 1);
  EXPECT_EQ(count(shaft_, tree_, {.own = {}}), size);
  EXPECT_EQ(count(shaft_, tree_, {}), size);
}

TEST_F(Excluded, BracesHoldARowForEachOfManyShafts) {
  const std::vector<CompiledShaft> shafts(2, shaft_);
  IndexLists lists;
  list_many(shafts, tree_, lists, {.own = {3, 7, 8, 9}});
  ASSERT_EQ(lists.size(), 2U);
  const auto has = [&](std::size_t shaft, std::uint32_t index) {
    return std::find(lists[shaft].begin(), lists[shaft].end(), index) != lists[shaft].end();
  };
  for (const std::uint32_t index : std::vector<std::uint32_t>{3, 7, 8, 9}) {
    EXPECT_EQ(has(0, index), index >= 8) << index;
    EXPECT_EQ(has(1, index), index < 8) << index;
  }
}

TEST_F(Excluded, IndicesMayBeAVectorAnArrayASpanOrAPointerAndASize) {
  const std::vector<std::uint32_t> vector = {3, 7};
  const std::array<std::uint32_t, 2> array = {3, 7};
  std::uint32_t c_array[] = {3, 7};
  const auto count_without = [&](const Excluding& excluding) { return count(shaft_, tree_, excluding); };
  EXPECT_EQ(count_without({.own = vector}), size - 2);
  EXPECT_EQ(count_without({.own = array}), size - 2);
  EXPECT_EQ(count_without({.own = c_array}), size - 2);
  EXPECT_EQ(count_without({.own = std::span(c_array)}), size - 2);
  EXPECT_EQ(count_without({.own = std::span<std::uint32_t>(c_array)}), size - 2);
  EXPECT_EQ(count_without({.own = std::span<const std::uint32_t>(vector).first(1)}), size - 1);
  EXPECT_EQ(count_without({.own = {vector.data(), 1}}), size - 1);
  EXPECT_EQ(count_without({.own = {vector.begin(), vector.end()}}), size - 2);
}

TEST_F(Excluded, BracesGoWithAMask) {
  const std::vector<std::uint64_t> mask = {1, 0};  // bound 0
  EXPECT_EQ(count(shaft_, tree_, {.own = {3, 7}, .mask = mask}), size - 3);
}

TEST_F(Excluded, IndicesInBracesAreChecked) {
  EXPECT_THROW(static_cast<void>(count(shaft_, tree_, {.own = {3, 100}})), InvalidArgument);
}

}  // namespace
}  // namespace shaftcull
