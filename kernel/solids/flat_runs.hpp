// SPDX-License-Identifier: MIT
/// Neighbouring triangles in one plane as convex polygons.
#pragma once

#include <vector>

#include "solids/plate.hpp"
#include "solids/welded_mesh.hpp"

namespace shaftcull::kernel {

/// Convex polygons in place of the triangles of a part, except triangles without area. A polygon is
///
/// * triangles that are exactly in one plane and connected across edges: all of them if these form a convex polygon,
///   else as many of them as greedy joining makes one, longest common edges first;
/// * or a plate in place of triangles that are nearly in one plane and nearly form one convex polygon;
/// * or two triangles that are nearly in one plane, as rounding leaves them. The first corner is on their common edge,
///   so its triangles with the other edges are these two (shaftcull/occluded.hpp);
/// * or one triangle.
///
/// Corners run counterclockwise as seen from the front. Corners within an edge are left out. Polygons that are no
/// plates have no back. O(n log n).
///
/// The proof that a segment crosses a triangle if it crosses the polygon: the edges of the polygon are the sum of the
/// edges of its triangles, since each joined edge occurs once in both directions. So the polygon's boundary surrounds a
/// point of the plane as often as its triangles cover the point.
[[nodiscard]] std::vector<Plate> flat_runs(const WeldedMesh& mesh, const WeldedMesh::Part& part);

}  // namespace shaftcull::kernel
