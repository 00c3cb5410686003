// SPDX-License-Identifier: MIT
/// The boxes of solids, as lists of the ladder number them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"
#include "visibility/box_clumps.hpp"

namespace shaftcull::kernel {

/// First the boxes around solid hulls, in the order of the hulls: a hull may hide only what the box around it hides.
/// Then boxes that make pairs occluded: solids, and what they are together.
struct SolidRows {
  std::vector<BoxRow> rows;
  std::size_t hulls = 0;
  /// So many rows, the first ones, block what all do. If solids that hold a part of an end are to block nothing, the
  /// others are asked as well: the larger box around one may hold an end that the smaller one does not.
  std::size_t largest = 0;
  BoxClumps clumps;  ///< of all rows
};

/// In modes in which denormals are what they are.
[[nodiscard]] SolidRows made_solid_rows(std::span<const Box> solids, std::span<const BoxRow> hull_boxes);

}  // namespace shaftcull::kernel
