// SPDX-License-Identifier: MIT
/// Ranges of indices, and cutting them into chunks of one length.
#pragma once

#include <algorithm>
#include <cstddef>

namespace shaftcull::kernel {

/// The indices first … first + size − 1.
struct IndexRange {
  std::size_t first;
  std::size_t size;
  [[nodiscard]] std::size_t end() const noexcept { return first + size; }
};

/// Chunk `i` of the indices 0 … whole − 1, cut into chunks of `length`. The last chunk may be shorter.
[[nodiscard]] constexpr IndexRange chunk_at(std::size_t whole, std::size_t length, std::size_t i) noexcept {
  return {i * length, std::min(length, whole - i * length)};
}

/// How many chunks of `length` that makes.
[[nodiscard]] constexpr std::size_t chunk_count(std::size_t whole, std::size_t length) noexcept {
  return whole / length + (whole % length != 0);
}

}  // namespace shaftcull::kernel
