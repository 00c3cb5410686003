// SPDX-License-Identifier: MIT
/// Which bounds of a word are in any of some layers.
#pragma once

#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// As KeepLayers in kernels/kernel_table.hpp. Plain loops, which compilers turn into vectors of the set's width: first
/// a byte a bound, then a multiplication that moves the lowest bits of eight bytes side by side.
template <class L>
std::uint64_t keep_layers(const std::uint32_t* layers, std::uint32_t mask) noexcept {
  std::uint64_t bits = 0;
  if constexpr (L::width == 1) {
    for (unsigned i = 0; i < word_bits; ++i) bits |= std::uint64_t{(layers[i] & mask) != 0} << i;
  } else {
    unsigned char is_kept[word_bits];
    for (unsigned i = 0; i < word_bits; ++i) is_kept[i] = (layers[i] & mask) != 0 ? 1 : 0;
    for (unsigned i = 0; i < word_bits; i += 8) {
      std::uint64_t eight = 0;
      for (unsigned k = 0; k < 8; ++k) eight |= std::uint64_t{is_kept[i + k]} << 8 * k;  // one load
      bits |= (eight * 0x0102040810204080 >> 56) << i;
    }
  }
  return bits;
}

}  // namespace shaftcull::kernel
