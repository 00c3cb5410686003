// SPDX-License-Identifier: MIT
/// Exact answers for single triangles: what kernels ask about a triangle of which floats cannot tell.
#pragma once

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// Whether the triangle, x, y, z of one vertex after the other, has no point in common with the shaft; added planes are
/// left out; with open contact, whether the relative interiors have none. It starts again from the floats that the user
/// gave. false if a coordinate is not finite. Not for a hull.
[[nodiscard]] bool triangle_misses(const ShaftData& shaft, const float (&triangle)[9]) noexcept;

/// Whether all three vertices are beyond one added plane, or with open contact on it. A vertex is not beyond a plane
/// that reads a coordinate of it that is not finite.
[[nodiscard]] bool triangle_beyond_plane(const ShaftData& shaft, const float (&triangle)[9]) noexcept;

}  // namespace shaftcull::kernel
