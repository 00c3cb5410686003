// SPDX-License-Identifier: MIT
/// Solid boxes: larger boxes from many, and one box inside a turned solid.
#pragma once

#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Returns larger boxes, which cover exactly the space that the given boxes cover. Two boxes are joined if they agree
/// to the bit on two axes and touch or overlap on the third: pieces of a wall become one box. Nothing is rounded. Where
/// two walls cross, each becomes whole, so boxes of the result may overlap. A box that lies in another box is left out.
/// The order is not that of `boxes`.
///
/// O(n log n) for the walls of a building. A grid of many small boxes takes more time and temporary memory, as there
/// are many ways to join them. Allocates the result and O(n) temporary memory. Throws BadBound for a box that is not
/// finite with lo ≤ hi, by its position; InvalidArgument for a null span; std::bad_alloc.
[[nodiscard]] SHAFTCULL_EXPORT std::vector<Box> merged_boxes(std::span<const Box> boxes);

/// Returns a large box inside the convex hull of 4 to 32 points. A search finds the box, so a larger one may exist; it
/// is the same on every machine for the same points. The box lies in the hull exactly: no coordinate is rounded
/// outwards. If the hull is flat, or too thin for floats, the result is one of `corners`, as a box.
///
/// O(n³): about 20 µs for 8 points, 2 ms for 32. Allocates temporary memory. Throws InvalidArgument for another number
/// of points, and for a point that is not finite; std::bad_alloc.
[[nodiscard]] SHAFTCULL_EXPORT Box inscribed_box(std::span<const Vec3> corners);

}  // namespace shaftcull
