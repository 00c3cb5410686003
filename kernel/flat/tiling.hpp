// SPDX-License-Identifier: MIT
/// Tiling: how many shafts × many bounds are cut into tasks. It depends on the sizes alone, never on the number of
/// threads.
#pragma once

#include <algorithm>
#include <cstddef>

#include "support/index_range.hpp"

namespace shaftcull::kernel {

/// Bounds in a tile: 24 KiB of boxes on a grid (kernel/kernels/grid/forming.hpp), so that these and the shafts tested
/// against them stay in a 32 KiB L1 cache; the floats that they were made from are 48 KiB. A multiple of 512, so that
/// tasks, which get whole tiles, share no word of results and, in aligned rows, no cache line either.
inline constexpr std::size_t tile_bounds = 2048;
inline constexpr std::size_t tile_words = tile_bounds / 64;

/// A block of up to this many bounds is one tile on a grid, of 30 KiB: with two tiles of half as many, each shaft would
/// pay twice for what it does once a tile.
inline constexpr std::size_t most_tile_bounds = 2560;

/// Bounds in a tile that several shafts test in floats: 24 KiB of boxes.
inline constexpr std::size_t float_tile_bounds = 1024;

/// Shafts in a group, which are tested against a tile while it is in the cache. Slab form reads two cache lines of a
/// shaft: 8 KiB a group.
inline constexpr std::size_t group_shafts = 64;

/// Tiles × shafts in a task: 2¹⁹ tests, some 80 µs, which makes the cost of starting a task vanish.
inline constexpr std::size_t task_tiles_times_shafts = 256;

/// Most tiles in a task: so many take as long to come from memory.
inline constexpr std::size_t most_task_tiles = 64;

/// Bounds in each of a block's tiles, the last one shorter: at most `most`, and as even as whole words allow, since a
/// tile of few bounds costs nearly as much as one of many.
[[nodiscard]] constexpr std::size_t even_tile(std::size_t bounds, std::size_t most) noexcept {
  const std::size_t tiles = std::max<std::size_t>(chunk_count(bounds, most), 1);
  return std::max<std::size_t>(64 * chunk_count(chunk_count(bounds, 64), tiles), 64);
}

/// Tasks in rows and columns, each a block of tiles × a group of shafts.
class Tiling {
 public:
  constexpr Tiling(std::size_t bounds, std::size_t shafts) noexcept
      : bounds_(bounds),
        shafts_(shafts),
        block_tiles_(task_tiles_times_shafts / std::clamp(shafts, fewest_task_shafts, group_shafts)) {}

  [[nodiscard]] constexpr std::size_t blocks() const noexcept { return chunk_count(bounds_, block_bounds()); }
  [[nodiscard]] constexpr std::size_t groups() const noexcept { return chunk_count(shafts_, group_shafts); }
  [[nodiscard]] constexpr std::size_t block_bounds() const noexcept { return block_tiles_ * tile_bounds; }

  /// The bounds of block `i`.
  [[nodiscard]] constexpr IndexRange block(std::size_t i) const noexcept {
    return chunk_at(bounds_, block_bounds(), i);
  }
  /// The shafts of group `i`.
  [[nodiscard]] constexpr IndexRange group(std::size_t i) const noexcept { return chunk_at(shafts_, group_shafts, i); }

 private:
  static constexpr std::size_t fewest_task_shafts = task_tiles_times_shafts / most_task_tiles;

  std::size_t bounds_;
  std::size_t shafts_;
  std::size_t block_tiles_;
};

}  // namespace shaftcull::kernel
