// SPDX-License-Identifier: MIT
/// Words of bits as a count and as a list of positions.
///
/// A loop "while the word is not zero" is a mispredicted branch a word. So, as in simdjson (Langdale and Lemire,
/// "Parsing Gigabytes of JSON per Second", 2019), a fixed number of positions is always written, and the end moves
/// on by the number of set bits; only a word with more of them takes a branch. That number follows from how many
/// bits are set on average.
#pragma once

#include "kernels/kernel_table.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// As SetBits has it.
template <class L>
std::size_t count_set_bits(const std::uint64_t* words, std::size_t count) noexcept {
  std::size_t bits = 0;
  for (std::size_t w = 0; w != count; ++w) bits += static_cast<std::size_t>(popcount(words[w]));
  return bits;
}

/// Always writes `step` positions of a word, and then as many more as it takes.
template <class L, std::size_t step>
void write_set_bits_by(const std::uint64_t* words, std::size_t count, std::uint32_t* out) noexcept {
  static_assert(step <= set_bits_slack);
  std::uint32_t first = 0;
  for (std::size_t w = 0; w != count; ++w, first += word_bits) {
    std::uint64_t word = words[w];
    std::uint32_t* const end = out + popcount(word);
    do {
      SHAFTCULL_UNROLL(16)
      for (std::size_t i = 0; i != step; ++i) {
        out[i] = first + L::lowest_bit(word);
        word &= word - 1;
      }
      out += step;
    } while (out < end);
    out = end;
  }
}

/// One bit after the other, where there are no vectors.
template <class L>
void write_set_bits_one_by_one(const std::uint64_t* words, std::size_t count, std::uint32_t* out) noexcept {
  std::uint32_t first = 0;
  for (std::size_t w = 0; w != count; ++w, first += word_bits) {
    for (std::uint64_t word = words[w]; word != 0; word &= word - 1) *out++ = first + L::lowest_bit(word);
  }
}

/// As SetBits has it.
template <class L>
void write_set_bits(const std::uint64_t* words, std::size_t count, std::size_t set, std::uint32_t* out) noexcept {
  if (set == 0) return;
  if constexpr (requires { typename L::PositionCompressor; }) {
    static_assert(L::PositionCompressor::at_once <= set_bits_slack);
    if (L::PositionCompressor::is_available()) return L::PositionCompressor::write(words, count, out);
  }
  if constexpr (L::width == 1) return write_set_bits_one_by_one<L>(words, count, out);
  // A word of evenly spread bits needs more than one step about once in fifty.
  if (2 * set <= count) return write_set_bits_by<L, 2>(words, count, out);
  if (set <= count) return write_set_bits_by<L, 3>(words, count, out);
  if (set <= 2 * count) return write_set_bits_by<L, 5>(words, count, out);
  if (set <= 4 * count) return write_set_bits_by<L, 8>(words, count, out);
  return write_set_bits_by<L, 16>(words, count, out);
}

}  // namespace shaftcull::kernel
