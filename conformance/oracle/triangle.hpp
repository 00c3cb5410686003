// SPDX-License-Identifier: MIT
/// Whether triangles are outside of a shaft, in exact rational arithmetic and straight from the definition: is there a
/// time, and a point of the triangle, such that the point is in the box then? Slow, and shares no code with the
/// library.
#pragma once

#include <gmpxx.h>

#include <array>
#include <string>
#include <vector>

#include "oracle/convex_hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {

/// C++ source text that makes the same values again, to the bit.
std::string source_text(const Triangle& triangle);

namespace oracle {

/// Whether the triangle, of finite vertices, has a point in common with the shaft; added planes are left out.
[[nodiscard]] bool meets(const ShaftInput& input, const Triangle& triangle);
[[nodiscard]] bool meets(const MovingInput& input, const Triangle& triangle);

/// Whether all three vertices are beyond one of the planes, or with open contact on it.
[[nodiscard]] bool is_beyond_one(const std::vector<Plane>& planes, const Triangle& triangle,
                                 Contact contact = Contact::closed);

/// The smallest box around the triangle.
[[nodiscard]] Box box_around(const Triangle& triangle);

/// What a test says.
[[nodiscard]] bool is_outside(const ShaftInput& input, const Triangle& triangle, TriangleTest test);
[[nodiscard]] bool is_outside(const MovingInput& input, const Triangle& triangle, TriangleTest test);
/// A hull whose test of boxes is exact.
[[nodiscard]] bool is_outside(const HullInput& input, const Triangle& triangle, TriangleTest test, Contact contact);

}  // namespace oracle
}  // namespace shaftcull
