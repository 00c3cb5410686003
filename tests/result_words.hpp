// SPDX-License-Identifier: MIT
/// Words that queries write results into.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shaftcull {

/// What they are filled with before the call, to see what it wrote.
inline constexpr std::uint64_t sentinel = 0x5e5e5e5e5e5e5e5e;

[[nodiscard]] inline bool bit(const std::vector<std::uint64_t>& words, std::size_t i) {
  return (words[i / 64] >> i % 64 & 1U) != 0;
}

}  // namespace shaftcull
