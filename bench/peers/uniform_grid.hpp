// SPDX-License-Identifier: MIT
/// A uniform grid over boxes of one size, as one would write it for short sweeps among them: what trees are measured
/// against in tree/equal_short/….
///
/// A cell holds the boxes whose centres are in it, so that every box is in one cell. Centres are sorted by cell into
/// one stream an axis, cells along x next to each other: a sweep reads one run of centres for each row of cells that it
/// may meet, a vector at a time, and tests the centres against the swept box grown by the boxes' half extents.
/// Arithmetic is that of floats, and answers near a boundary are as rounded as it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::bench {

struct UniformGrid {  // NOLINT(bugprone-reserved-identifier): of a loop in the copy that nobody wrote
  /// The boxes must all be of the first one's size, to a few roundings. `cell` is the side of a cell.
  UniformGrid(std::span<const Box> boxes, float cell);

  /// A sweep writes whole vectors: it needs room for that many more indices than it finds.
  static constexpr std::size_t most_written_more = 16;

  float half[3];    ///< of all boxes
  float origin[3];  ///< corner of the first cell
  float inverse_cell;
  int cells[3];
  std::vector<float> centre[3];      ///< by cell, padded with a vector
  std::vector<std::uint32_t> index;  ///< of the box, likewise
  std::vector<std::uint32_t> first;  ///< centre of each cell, x fastest, and one more for the end
};

/// Writes the indices of the boxes that the box meets on its way from `from` to `to`, both of one size, and returns how
/// many.
using SweepGrid = std::size_t(const UniformGrid& grid, const Box& from, const Box& to, std::uint32_t* found) noexcept;

/// The sweep for `isa`, or null: there are some for avx2 and avx512, where this build and this machine have them.
[[nodiscard]] SweepGrid* sweep_grid(Isa isa) noexcept;

}  // namespace shaftcull::bench
