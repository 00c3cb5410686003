// SPDX-License-Identifier: MIT
/// Lists in room of every size, and in rows.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "options/scenes.hpp"
#include "oracle/random.hpp"
#include "result_words.hpp"
#include "shaftcull/results.hpp"

namespace shaftcull {

/// Room for none of the results, for some, for all and for more; of many results, for two of these only.
inline std::vector<std::size_t> rooms_for(Random& random, std::size_t results) {
  const std::set<std::size_t> sizes = {0,       1,           results / 2, results - (results == 0 ? 0 : 1),
                                       results, results + 1, results + 65};
  std::vector<std::size_t> rooms(sizes.begin(), sizes.end());
  while (results > 500 && rooms.size() > 2) {
    rooms.erase(rooms.begin() + static_cast<std::ptrdiff_t>(random.below(static_cast<unsigned>(rooms.size()))));
  }
  return rooms;
}

/// One of them.
inline std::size_t a_room_for(Random& random, std::size_t results) {
  const std::vector<std::size_t> rooms = rooms_for(random, results);
  return rooms[random.below(static_cast<unsigned>(rooms.size()))];
}

/// A list into room for `room` of them holds the first that fit, and nothing past the room is written.
template <class List>
void expect_listed(const Indices& results, std::size_t room, const List& list) {
  constexpr auto unwritten = static_cast<std::uint32_t>(sentinel);
  Indices memory(room + 64, unwritten);
  list(std::span(memory).first(room));
  const auto fit = static_cast<std::ptrdiff_t>(std::min(room, results.size()));
  EXPECT_TRUE(std::equal(results.begin(), results.begin() + fit, memory.begin()))
      << "room for " << room << " of " << results.size();
  EXPECT_TRUE(std::all_of(memory.begin() + static_cast<std::ptrdiff_t>(room), memory.end(),
                          [](std::uint32_t each) { return each == unwritten; }))
      << "written past the room for " << room << " of " << results.size();
}

/// Lists of all shafts are these.
inline void expect_lists(const IndexLists& lists, const std::vector<Indices>& right, const char* verb) {
  ASSERT_EQ(lists.size(), right.size()) << verb;
  ASSERT_EQ(lists.offsets[0], 0U) << verb;
  ASSERT_EQ(lists.offsets.back(), lists.indices.size()) << verb;
  for (std::size_t s = 0; s != right.size(); ++s) {
    ASSERT_LE(lists.offsets[s], lists.offsets[s + 1]) << verb << ", shaft " << s;
    const std::span<const std::uint32_t> list = lists[s];
    ASSERT_EQ(list.size(), right[s].size()) << verb << ", shaft " << s;
    ASSERT_TRUE(std::equal(list.begin(), list.end(), right[s].begin())) << verb << ", shaft " << s;
  }
}

/// Values are right: `row` of them for each shaft, one row behind the other.
template <class T>
void expect_rows(const std::vector<T>& rows, const std::vector<T>& right, const char* verb, std::size_t row = 1) {
  ASSERT_EQ(rows.size(), right.size()) << verb;
  const auto [wrong, expected] = std::mismatch(rows.begin(), rows.end(), right.begin());
  if (wrong == rows.end()) return;
  const auto at = static_cast<std::size_t>(wrong - rows.begin());
  FAIL() << verb << ", shaft " << at / row << ", place " << at % row << " of " << row << ": "
         << testing::PrintToString(*wrong) << " instead of " << testing::PrintToString(*expected);
}

}  // namespace shaftcull
