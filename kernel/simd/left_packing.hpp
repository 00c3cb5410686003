// SPDX-License-Identifier: MIT
/// Shuffles that put some lanes of a vector side by side, for sets that have no instruction for it: NEON, SSE4.2
/// and AVX2.
#pragma once

#include <cstdint>

namespace shaftcull::kernel {

/// For every set of `width` lanes, the shuffle of parts of `size` to a lane: where each part of the packed vector comes
/// from.
template <unsigned width, unsigned size>
struct LeftPacking {
  alignas(16) std::uint8_t part[1U << width][width * size] = {};

  constexpr LeftPacking() noexcept {
    for (unsigned lanes = 0; lanes < 1U << width; ++lanes) {
      unsigned to = 0;
      for (unsigned lane = 0; lane < width; ++lane) {
        if ((lanes >> lane & 1U) == 0) continue;
        for (unsigned p = 0; p < size; ++p) part[lanes][to++] = static_cast<std::uint8_t>(lane * size + p);
      }
    }
  }
};
template <unsigned width, unsigned size>
inline constexpr LeftPacking<width, size> left_packing;

}  // namespace shaftcull::kernel
