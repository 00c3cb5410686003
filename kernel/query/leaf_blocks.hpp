// SPDX-License-Identifier: MIT
/// Bounds that are not in one piece: those of a dynamic tree are in blocks, each in memory of its own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::kernel {

/// Leaves of a block: those below one word of nodes.
inline constexpr std::size_t block_leaves = 4096;

/// The position of a leaf of a block in each of the block's streams. Streams are interleaved word by word: the rows of
/// 64 leaves follow one another, so a word lies in one or two pages of memory.
[[nodiscard]] constexpr std::size_t place_in_block(std::size_t leaf, std::size_t rows) noexcept {
  return leaf % block_leaves / 64 * 64 * rows + leaf % 64;
}

/// Where the blocks of a tree are. Leaf p is in block p / block_leaves. Behind the last block is one more, which holds
/// a single empty bound: the leaf of indices that belong to no bound.
struct LeafBlocks {
  const float* const* row = nullptr;             ///< the streams of each block (place_in_block()); null: in one piece
  const std::uint64_t* const* taken = nullptr;   ///< of each block, for each word of leaves: those that are not free
  const std::uint32_t* const* order = nullptr;   ///< of each block, the user's index of its leaves
  const std::uint32_t* const* layers = nullptr;  ///< of each block; null if all bounds are in all layers
  const std::uint32_t* const* place = nullptr;   ///< of each page of indices, their places
  const std::uint32_t* position_of = nullptr;    ///< where the block of a number is

  [[nodiscard]] bool exist() const noexcept { return row != nullptr; }

  /// A place: the number of a block, which stays the same while blocks change their positions, and a leaf of it.
  static constexpr unsigned number_shift = 12;
  static_assert(std::size_t{1} << number_shift == block_leaves);
  static constexpr std::uint32_t page_size = 4096;  ///< indices in a page
  [[nodiscard]] static constexpr std::size_t pages_for(std::size_t indices) noexcept {
    return (indices + page_size - 1) / page_size;
  }

  /// The leaf of an index.
  [[nodiscard]] std::uint32_t leaf_of(std::uint32_t index) const noexcept {
    const std::uint32_t at = place[index / page_size][index % page_size];
    return static_cast<std::uint32_t>(position_of[at >> number_shift] * block_leaves + at % block_leaves);
  }
};

}  // namespace shaftcull::kernel
