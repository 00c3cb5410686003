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
/// Then boxes that make pairs occluded.
struct SolidRows {
  std::vector<BoxRow> rows;
  std::size_t hulls = 0;
  BoxClumps clumps;  ///< of all rows
};

// Both in modes in which denormals are what they are.

/// The larger boxes that boxes form together, and those of the boxes that block a pair that no larger one does.
[[nodiscard]] SolidRows solid_rows(std::span<const Box> boxes, std::span<const BoxRow> hull_boxes);
/// For solids that block nothing if they hold a part of an end: the larger boxes, and all of the boxes, since the
/// larger one may hold an end that the smaller one does not.
[[nodiscard]] SolidRows surface_rows(std::span<const Box> boxes, std::span<const BoxRow> hull_boxes);

}  // namespace shaftcull::kernel
