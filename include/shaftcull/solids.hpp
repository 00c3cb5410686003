// SPDX-License-Identifier: MIT
/// Solid boxes: larger ones out of many, and one inside a turned solid.
#pragma once

#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Larger boxes, which cover what the given ones cover and nothing else. Two boxes are joined if they agree to the bit
/// on two axes and touch or overlap on the third: pieces of a wall become one box. Nothing is rounded. Where two walls
/// cross, each becomes whole, so boxes of the result may overlap. A box that lies in another one is left out. The order
/// is not that of `boxes`.
///
/// O(n log n) for the walls of a building. A grid of many small boxes takes longer, and more memory on the way, since
/// there are many ways to join them. Allocates the result and O(n) on the way. Throws BadBound for a box that is not
/// finite with lo ≤ hi, by its position; InvalidArgument for a null span; std::bad_alloc.
[[nodiscard]] SHAFTCULL_EXPORT std::vector<Box> merged_boxes(std::span<const Box> boxes);

/// A large box inside the convex hull of 4 to 32 points. A search finds it, so there may be a larger one; the same is
/// found for the same points on every machine. It lies in the hull exactly: no coordinate is rounded outwards. If the
/// hull is flat, or too thin for floats, the result is one of `corners`, as a box.
///
/// O(n³): some 20 µs for 8 points, 2 ms for 32. Allocates memory on the way. Throws InvalidArgument for another number
/// of points, or one that is not finite; std::bad_alloc.
[[nodiscard]] SHAFTCULL_EXPORT Box inscribed_box(std::span<const Vec3> corners);

}  // namespace shaftcull
