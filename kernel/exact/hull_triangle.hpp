// SPDX-License-Identifier: MIT
/// Exact answers of convex hulls for single triangles.
#pragma once

#include "compiled/hull_data.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// Whether the triangle, x, y, z of one vertex after the other, has no point in common with the hull; with open
/// contact, whether the relative interiors have none. It starts again from the floats that the user gave. false if a
/// coordinate is not finite. The hull's test does not matter.
[[nodiscard]] bool triangle_misses_hull(const HullData& hull, Contact contact, const float (&triangle)[9]) noexcept;

}  // namespace shaftcull::kernel
