// SPDX-License-Identifier: MIT
/// What the shafts of one block answer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

#include "batch/question.hpp"

namespace shaftcull::batch {

/// Lists of bounds, one behind the other.
struct BlockLists {
  std::vector<std::uint64_t> sizes;    ///< how many each list has
  std::vector<std::uint64_t> indices;  ///< of all lists

  friend bool operator==(const BlockLists&, const BlockLists&) = default;
};

/// Answers of those shafts of a block that have something to tell. Members that the question does not ask for are
/// empty.
struct BlockAnswer {
  std::vector<std::uint32_t> rows;     ///< which shafts: positions in the block, ascending
  std::vector<std::uint64_t> numbers;  ///< of each: how many it keeps, or which it reaches first
  std::vector<float> times;            ///< of each: when
  std::array<BlockLists, 2> lists;     ///< of each: what it keeps; or what overlaps, and what is inside

  /// As BlockStore wants them.
  template <class Self>
  [[nodiscard]] static auto arrays(Self& self) {
    return std::tie(self.rows, self.numbers, self.times, self.lists[0].sizes, self.lists[0].indices,
                    self.lists[1].sizes, self.lists[1].indices);
  }

  friend bool operator==(const BlockAnswer&, const BlockAnswer&) = default;
};

/// Whether bound `one` is reached before bound `other` by the shaft in this row of the block; both at the same time,
/// rounded down, so that only exact times tell.
using ReachedBefore = std::function<bool(std::uint32_t row, std::uint64_t one, std::uint64_t other)>;

/// The answers of a block of all bounds, from those of the shares: counts are added, lists joined and sorted, first
/// contacts compared. What one share answers is answered as it is.
[[nodiscard]] BlockAnswer merge(std::vector<BlockAnswer> shares, Answer answer, const ReachedBefore& before);

/// How many lists there are a shaft: 2, 1 or 0.
[[nodiscard]] constexpr std::size_t lists_of(Answer answer) noexcept {
  return answer == Answer::classify ? 2 : answer == Answer::list ? 1 : 0;
}

}  // namespace shaftcull::batch
