// SPDX-License-Identifier: MIT
/// Exact answers of convex hulls for single bounds.
#pragma once

#include "compiled/hull_data.hpp"

namespace shaftcull::kernel {

/// Whether the box with the corners of `bound` (order of a BoxView's streams) misses the hull; if this is conservative,
/// whether the box is beyond a plane that such hulls cull by. One with lo > hi on an axis is.
[[nodiscard]] bool hull_box_outside(const HullData& hull, const float (&bound)[6]) noexcept;

/// The same with open contact: whether the relative interiors have no point in common; if the hull is conservative,
/// whether such a plane has the box beyond it or in it, and does not hold both the box and the hull.
[[nodiscard]] bool hull_box_outside_openly(const HullData& hull, const float (&bound)[6]) noexcept;

/// Whether that box is inside the hull.
[[nodiscard]] bool hull_box_inside(const HullData& hull, const float (&bound)[6]) noexcept;

/// Whether that box is in the interior of the hull.
[[nodiscard]] bool hull_box_strictly_inside(const HullData& hull, const float (&bound)[6]) noexcept;

/// Whether the sphere (centre x, y, z, radius) is beyond a plane of the hull or a face of its box by more than its
/// radius. Of planes with three coordinates or two, only where doubles say so for certain, in one order of operations
/// on every machine: a sphere that touches one within some 2⁻⁴⁰ is not outside, unless the box around it misses the
/// hull, as the nodes of a tree would have it.
[[nodiscard]] bool hull_sphere_outside(const HullData& hull, const float (&sphere)[4]) noexcept;

/// The same with open contact: also a sphere that touches a face of the hull's box, and one the box around which is
/// outside openly.
[[nodiscard]] bool hull_sphere_outside_openly(const HullData& hull, const float (&sphere)[4]) noexcept;

/// Whether the sphere is inside all of them, by its radius at least; likewise only where doubles say so for certain, or
/// the box around it is inside.
[[nodiscard]] bool hull_sphere_inside(const HullData& hull, const float (&sphere)[4]) noexcept;

}  // namespace shaftcull::kernel
