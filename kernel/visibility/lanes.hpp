// SPDX-License-Identifier: MIT
/// Lanes: bits of a word, one for each of at most 64 groups or patches side by side.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shaftcull::kernel {

/// Calls visit(lane) for every bit that is set, ascending.
template <class Visit>
void for_each_lane(std::uint64_t lanes, const Visit& visit) {
  for (; lanes != 0; lanes &= lanes - 1) visit(static_cast<unsigned>(std::countr_zero(lanes)));
}

/// Calls visit(first, count) for every run of bits that are set, ascending.
template <class Visit>
void for_each_run(std::uint64_t lanes, const Visit& visit) {
  while (lanes != 0) {
    const auto first = static_cast<unsigned>(std::countr_zero(lanes));
    const auto count = static_cast<unsigned>(std::countr_one(lanes >> first));
    visit(first, count);
    if (first + count == 64) return;
    lanes &= ~std::uint64_t{0} << (first + count);
  }
}

/// The first `count` lanes, at most 64.
[[nodiscard]] inline std::uint64_t first_lanes(unsigned count) noexcept {
  return count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

[[nodiscard]] inline std::uint64_t bit(unsigned lane) noexcept { return std::uint64_t{1} << lane; }

/// Lanes of some of these words.
[[nodiscard]] inline std::uint64_t any_of(const std::uint64_t* words, std::size_t count) noexcept {
  std::uint64_t any = 0;
  for (std::size_t i = 0; i != count; ++i) any |= words[i];
  return any;
}

/// Copies the numbers of a list of `count` whose words have the bit of a lane.
inline void copy_of_lane(const std::uint32_t* list, const std::uint64_t* words, std::size_t count, unsigned lane,
                         std::vector<std::uint32_t>& to) {
  to.resize(count + 1);  // what is not copied is written, too
  std::size_t copied = 0;
  for (std::size_t i = 0; i != count; ++i) {  // without branches, which would be mispredicted
    to[copied] = list[i];
    copied += words[i] >> lane & 1U;
  }
  to.resize(copied);
}

}  // namespace shaftcull::kernel
