// SPDX-License-Identifier: MIT
/// Two polygons between which a wall of many triangles lies, where rounding has moved vertices out of one plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "solids/welded_mesh.hpp"

namespace shaftcull::kernel {

/// Corners of a convex polygon in front of triangles, and of one behind them, in the same order: counterclockwise as
/// seen from the front.
struct Plate {
  std::vector<Vec3> front;
  std::vector<Vec3> back;
};

/// Plates in place of triangles that are nearly in one plane, each in a convex part of what they cover: one for a
/// rectangular wall, a few for an L-shaped floor or a wall with windows. None if the triangles are further from one
/// plane than rounding leaves them. `triangles` are of the mesh. `boundary` has the edges of these, as WeldedMesh
/// numbers them, that have none of these across. Sets is_covered[i] if triangle i is within a plate.
///
/// The proof that a segment crosses a triangle if it crosses both polygons: looked at along one axis, all triangles
/// have the same orientation, and the corners of both polygons are those of one convex polygon C. No edge of the
/// boundary reaches into C, and the boundary goes around C. So the triangles cover each point of C as often as the
/// boundary goes around it, all with one sign. Let the front polygon be above. It is above all vertices of the
/// triangles, and the back polygon below: they are on either side of a slab that holds all vertices. The part of the
/// segment between both polygons stays above C, and leads from above the triangles to below, so it crosses one. Each
/// inequality holds with the errors of its numbers, or is exact. O(plates · boundary · corners + triangles).
[[nodiscard]] std::vector<Plate> plates_of(const WeldedMesh& mesh, std::span<const std::uint32_t> triangles,
                                           std::span<const std::uint32_t> boundary, std::vector<bool>& is_covered);

}  // namespace shaftcull::kernel
