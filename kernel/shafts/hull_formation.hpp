// SPDX-License-Identifier: MIT
/// The planes of a convex hull, from its vertices.
#pragma once

#include "compiled/hull_data.hpp"
#include "exact/small_hull.hpp"

namespace shaftcull::kernel {

/// Forms a hull of the vertices that it has: finds its box and all planes, with the margins of floats, and the
/// triangles around it, if it has an interior. Needs the standard floating-point modes. O(n²).
void form_hull(HullData& hull, SmallHull& triangles) noexcept;

/// The same to the bit, for a hull that has the vertices of `view`, none of them a direction, and one more behind them,
/// from the planes and triangles of that, if there are any.
void form_extended_hull(HullData& hull, SmallHull& triangles, const HullData& view,
                        const SmallHull& triangles_of_view) noexcept;

/// The same to the bit, for any hull, by comparing all vertices with the plane of each three and the line of each two.
/// O(n³) and more. form_hull() does so for flat hulls, and for those whose directions are on no side of any plane.
void form_hull_by_search(HullData& hull) noexcept;

}  // namespace shaftcull::kernel
