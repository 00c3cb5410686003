// SPDX-License-Identifier: MIT
/// Answers of triangles: the library says which are outside, and of points which are inside.
#pragma once

#include <span>

#include "shaft_choice.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::cli {

/// Whether all of these points are inside the shaft. It is convex, so that a triangle is inside iff its vertices are.
/// Points in the surface of a shaft with open contact are outside, but those of a triangle that is inside may be
/// there: pass the shaft with closed contact.
[[nodiscard]] bool all_inside(const CompiledShaft& closed, std::span<const Vec3> points);

/// By the exact test, of the shaft that `choice` forms of boxes `from` and `to`; not of a convex hull.
[[nodiscard]] Answer answer_of(const Triangle& triangle, const ShaftChoice& choice, const Box& from, const Box& to);

}  // namespace shaftcull::cli
