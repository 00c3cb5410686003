// SPDX-License-Identifier: MIT
/// Answers as bits: that of bound i is bit i % 64 of word i / 64.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace shaftcull::cli {

/// The bit of bound i, in its word.
constexpr std::uint64_t bit_of(std::size_t i) noexcept { return std::uint64_t{1} << i % 64; }

/// How many bits are set.
[[nodiscard]] constexpr std::uint64_t bits_in(std::span<const std::uint64_t> words) noexcept {
  std::uint64_t count = 0;
  for (const std::uint64_t word : words) count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

}  // namespace shaftcull::cli
