// SPDX-License-Identifier: MIT
/// Compressing indices by the bits of a word: the user's indices of the leaves in a word that a shaft keeps.
#pragma once

#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// As CompressIndices in kernels/kernel_table.hpp. No branch depends on the bits: it would be mispredicted.
template <class L>
std::size_t compress_indices(const std::uint32_t* from, std::uint64_t bits, std::uint32_t* out) noexcept {
  const std::uint32_t* const start = out;
  if constexpr (L::width == 1) {
    for (; bits != 0; bits &= bits - 1) *out++ = from[L::lowest_bit(bits)];
  } else {
    for (unsigned i = 0; i < word_bits; i += L::width) {
      const std::uint64_t lanes = bits >> i & lanes_of<L>(0);
      typename L::Compressor(lanes).store(out, from + i);
      out += popcount(lanes);
    }
  }
  return static_cast<std::size_t>(out - start);
}

}  // namespace shaftcull::kernel
