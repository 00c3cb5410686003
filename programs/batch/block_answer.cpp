// SPDX-License-Identifier: MIT
#include "batch/block_answer.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace shaftcull::batch {
namespace {

/// Where reading one share's answers has come to.
struct Cursor {
  const BlockAnswer* answer;
  std::size_t at = 0;                            ///< the next row
  std::array<std::size_t, 2> first_index{0, 0};  ///< of its lists

  [[nodiscard]] bool has(std::uint32_t row) const { return at != answer->rows.size() && answer->rows[at] == row; }
  void step(std::size_t lists) {
    for (std::size_t l = 0; l != lists; ++l) first_index[l] += answer->lists[l].sizes[at];
    ++at;
  }
};

void append_list(const Cursor& from, std::size_t l, std::vector<std::uint64_t>& to) {
  const BlockLists& lists = from.answer->lists[l];
  const auto list = std::span(lists.indices).subspan(from.first_index[l], lists.sizes[from.at]);
  to.insert(to.end(), list.begin(), list.end());
}

}  // namespace

BlockAnswer merge(std::vector<BlockAnswer> shares, Answer answer, const ReachedBefore& before) {
  if (shares.size() == 1) return std::move(shares.front());
  BlockAnswer all;
  std::vector<Cursor> cursors;
  for (const BlockAnswer& share : shares) {
    all.rows.insert(all.rows.end(), share.rows.begin(), share.rows.end());
    cursors.push_back({&share});
  }
  std::ranges::sort(all.rows);
  all.rows.erase(std::unique(all.rows.begin(), all.rows.end()), all.rows.end());
  const std::size_t lists = lists_of(answer);
  for (const std::uint32_t row : all.rows) {
    std::uint64_t number = 0;
    float time = 0;
    bool found = false;
    std::array<std::size_t, 2> begin{all.lists[0].indices.size(), all.lists[1].indices.size()};
    for (Cursor& cursor : cursors) {
      if (!cursor.has(row)) continue;
      if (answer == Answer::count) number += cursor.answer->numbers[cursor.at];
      if (answer == Answer::first) {
        const std::uint64_t index = cursor.answer->numbers[cursor.at];
        const float when = cursor.answer->times[cursor.at];
        if (!found || when < time || (when == time && before(row, index, number))) {
          number = index;
          time = when;
        }
        found = true;
      }
      for (std::size_t l = 0; l != lists; ++l) append_list(cursor, l, all.lists[l].indices);
      cursor.step(lists);
    }
    if (answer == Answer::count || answer == Answer::first) all.numbers.push_back(number);
    if (answer == Answer::first) all.times.push_back(time);
    for (std::size_t l = 0; l != lists; ++l) {
      BlockLists& to = all.lists[l];
      std::sort(to.indices.begin() + static_cast<std::ptrdiff_t>(begin[l]), to.indices.end());
      to.sizes.push_back(to.indices.size() - begin[l]);
    }
  }
  return all;
}

}  // namespace shaftcull::batch
