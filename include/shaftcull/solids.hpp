// SPDX-License-Identifier: MIT
/// Solid boxes: larger ones out of many, and one inside a turned solid.
#pragma once

#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Boxes that cover nothing but what the given ones cover, as large as touching and overlapping ones make them: pieces
/// of a wall that share a face become one box. A box that lies in another one of the result is left out. A wall that
/// crosses another one is made whole as well as that one, so boxes of the result may overlap. Two boxes with
/// a face in common to the last bit are joined; nothing is rounded. Throws BadBound for a box that is not finite with
/// lo ≤ hi, by its position. Some O(n log n) in practice.
[[nodiscard]] std::vector<Box> merged_boxes(std::span<const Box> boxes);

/// A large box inside the convex hull of some points, 4 to 32 of them. It lies in the hull exactly: no coordinate is
/// rounded outwards. Where the hull is flat or too thin for floats, the box is a point of it that is one of `corners`.
/// Throws InvalidArgument for another number of points or one that is not finite.
[[nodiscard]] Box inscribed_box(std::span<const Vec3> corners);

}  // namespace shaftcull
