// SPDX-License-Identifier: MIT
/// Indices of set bits, written to the caller's memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/kernel_table.hpp"

namespace shaftcull::kernel {

/// Writes positions of set bits to the user's span. Those that do not fit are only counted.
class IndexWriter {
 public:
  IndexWriter(const SetBits& set_bits, std::span<std::uint32_t> out) noexcept : set_bits_(set_bits), out_(out) {}

  /// Those of `words` words, the first bit being that of bound `first`.
  void add(std::size_t first, const std::uint64_t* bits, std::size_t words) noexcept {
    constexpr std::size_t most_words = 32;
    for (std::size_t w = 0; w < words; w += most_words) {
      const std::size_t some = std::min(most_words, words - w);
      const std::size_t set = set_bits_.count(bits + w, some);
      if (set != 0 && count_ < out_.size()) {
        std::uint32_t position[most_words * 64 + set_bits_slack];
        set_bits_.write(bits + w, some, set, position);
        const auto from = static_cast<std::uint32_t>(first + w * 64);
        std::transform(position, position + std::min(set, out_.size() - count_), out_.data() + count_,
                       [from](std::uint32_t i) { return static_cast<std::uint32_t>(from + i); });
      }
      count_ += set;
    }
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

 private:
  const SetBits& set_bits_;
  std::span<std::uint32_t> out_;
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
