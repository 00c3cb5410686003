// SPDX-License-Identifier: MIT
/// Bounds that are scanned: all of some streams, or those that a query names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "query/bound_streams.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"

namespace shaftcull::kernel {

/// The leaf of every index of a tree; nothing for a view, whose indices are positions.
class Positions {
 public:
  Positions() noexcept = default;
  explicit Positions(const std::uint32_t* place) noexcept : place_(place) {}

  [[nodiscard]] std::uint32_t operator[](std::uint32_t index) const noexcept {
    return place_ == nullptr ? index : place_[index];
  }
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::uint32_t index) const noexcept {
    if (place_ != nullptr) prefetch_to_second_level(place_ + index, 1);
  }

 private:
  const std::uint32_t* place_ = nullptr;
};

/// The bounds that are scanned. Checked by who makes it.
struct ScannedBounds {
  BoundStreams streams;
  const std::uint32_t* layers;                               ///< by position; null if there are none
  std::optional<std::span<const std::uint32_t>> candidates;  ///< the bounds asked about, by index; all if not given
  Positions position;                                        ///< of candidates in the streams
};

/// Copies bounds [first, first + size) of those named by `indices` to row[r][0 … size).
inline void gather(const BoundStreams& bounds, std::span<const std::uint32_t> indices, const Positions& position,
                   std::size_t first, std::size_t size, float* const* row) noexcept {
  // How far ahead of the bound that is copied others are prefetched, and for trees the positions of leaves.
  constexpr std::size_t prefetched_bounds = 16;
  constexpr std::size_t prefetched_places = 32;
  for (std::size_t i = 0; i != size; ++i) {
    if (first + i + prefetched_places < indices.size()) position.prefetch(indices[first + i + prefetched_places]);
    if (first + i + prefetched_bounds < indices.size()) {
      const std::size_t soon = position[indices[first + i + prefetched_bounds]];
      for (std::size_t r = 0; r != bounds.rows; ++r) prefetch_to_second_level(bounds.stream[r] + soon, 1);
    }
    const std::size_t at = position[indices[first + i]];
    for (std::size_t r = 0; r != bounds.rows; ++r) row[r][i] = bounds.stream[r][at];
  }
}

}  // namespace shaftcull::kernel
