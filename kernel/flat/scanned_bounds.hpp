// SPDX-License-Identifier: MIT
/// Bounds that are scanned: all of some streams, or those that a query names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "query/bound_streams.hpp"
#include "query/leaf_blocks.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"

namespace shaftcull::kernel {

/// The leaf of every index of a tree, or nothing for a view, whose indices are positions.
class Positions {
 public:
  Positions() noexcept = default;
  explicit Positions(const std::uint32_t* place) noexcept : place_(place) {}
  explicit Positions(const LeafBlocks& blocks) noexcept : blocks_(&blocks) {}

  [[nodiscard]] std::uint32_t operator[](std::uint32_t index) const noexcept {
    if (place_ != nullptr) return place_[index];
    return blocks_ == nullptr ? index : blocks_->leaf_of(index);
  }
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::uint32_t index) const noexcept {
    if (place_ != nullptr) prefetch_to_second_level(place_ + index, 1);
  }

 private:
  const std::uint32_t* place_ = nullptr;
  const LeafBlocks* blocks_ = nullptr;
};

/// A bound in separate streams.
struct BoundPlace {
  const float* const* stream;
  std::size_t i;
};

/// The bounds that are scanned. Checked by who makes it.
struct ScannedBounds {
  BoundStreams streams;
  const std::uint32_t* layers;                               ///< by position; null if there are none
  std::optional<std::span<const std::uint32_t>> candidates;  ///< the bounds asked about, by index; all if not given
  Positions position;                                        ///< of candidates in the streams
  LeafBlocks blocks{};  ///< if they exist, candidates are there, and not in the streams

  /// The bound at a position.
  [[nodiscard]] BoundPlace at(std::size_t position_of_bound) const noexcept {
    if (!blocks.exist()) return {streams.stream, position_of_bound};
    return {blocks.row + position_of_bound / block_leaves * streams.rows,
            place_in_block(position_of_bound, streams.rows)};
  }
  /// The layers of the bound at a position, if there are any.
  [[nodiscard]] std::uint32_t layers_at(std::size_t position_of_bound) const noexcept {
    if (!blocks.exist()) return layers[position_of_bound];
    if (blocks.layers == nullptr) return ~std::uint32_t{0};
    return blocks.layers[position_of_bound / block_leaves][position_of_bound % block_leaves];
  }
};

/// Copies candidates [first, first + size) to row[r][0 … size).
inline void gather(const ScannedBounds& bounds, std::size_t first, std::size_t size, float* const* row) noexcept {
  // How far ahead of the bound that is copied others are prefetched, and for trees the positions of leaves.
  constexpr std::size_t prefetched_bounds = 16;
  constexpr std::size_t prefetched_places = 32;
  const std::span<const std::uint32_t> indices = *bounds.candidates;
  const Positions& position = bounds.position;
  for (std::size_t i = 0; i != size; ++i) {
    if (first + i + prefetched_places < indices.size()) position.prefetch(indices[first + i + prefetched_places]);
    if (first + i + prefetched_bounds < indices.size()) {
      const BoundPlace soon = bounds.at(position[indices[first + i + prefetched_bounds]]);
      for (std::size_t r = 0; r != bounds.streams.rows; ++r) prefetch_to_second_level(soon.stream[r] + soon.i, 1);
    }
    const BoundPlace bound = bounds.at(position[indices[first + i]]);
    for (std::size_t r = 0; r != bounds.streams.rows; ++r) row[r][i] = bound.stream[r][bound.i];
  }
}

}  // namespace shaftcull::kernel
