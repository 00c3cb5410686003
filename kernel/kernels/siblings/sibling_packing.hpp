// SPDX-License-Identifier: MIT
/// Siblings that are left, side by side: so that vectors are full.
#pragma once

#include "kernels/shared/word.hpp"
#include "kernels/siblings/siblings.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Whether a set can move bits as it moves lanes. Others would lose by packing.
template <class L>
concept MovesBits = requires(std::uint64_t bits) {
  L::packed_bits(bits, bits);
  L::spread_bits(bits, bits);
};

/// As SiblingKernels has it.
template <class L>
void pack_siblings(const float* const* other, unsigned count, std::uint64_t lanes, PackedBoxes& packed) noexcept {
  unsigned at = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    const std::uint64_t some = lanes >> lane & lanes_of<L>(0);
    if (some == 0) continue;
    const typename L::Compressor compressor(some);
    for (unsigned f = 0; f < 6; ++f) compressor.store(packed.face[f] + at, L::load(other[f] + lane));
    at += static_cast<unsigned>(popcount(some));
  }
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t spread_siblings(std::uint64_t bits, std::uint64_t lanes) noexcept {
  return L::spread_bits(bits, lanes);
}

/// As SiblingKernels has it.
template <class L>
std::size_t select_listed(const ListedSides& listed, std::size_t count, unsigned row, std::uint64_t lanes, bool packed,
                          std::uint32_t* selected, std::uint64_t* may) noexcept {
  std::size_t at = 0;
  for (std::size_t i = 0; i != count; ++i) {  // without branches, which would be mispredicted
    const std::uint64_t columns = listed.columns[i] & lanes;
    selected[at] = listed.list[i];
    if constexpr (MovesBits<L>) {
      may[at] = packed ? L::packed_bits(columns, lanes) : columns;
    } else {
      may[at] = columns;
    }
    at += (listed.rows[i] >> row & 1U) & static_cast<std::uint64_t>(columns != 0);
  }
  return at;
}

}  // namespace shaftcull::kernel
