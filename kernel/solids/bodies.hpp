// SPDX-License-Identifier: MIT
/// Closed parts of a mesh that are convex bodies.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "solids/welded_mesh.hpp"

namespace shaftcull::kernel {

/// The corners of a convex body that lies within a closed part, whose faces look outwards; nothing if there is none.
///
/// The proof: every corner is on or behind the plane of every triangle. So from any point in the interior of the body,
/// all triangles are seen from behind. The part has no boundary, or only one beyond the region. So it covers all
/// directions into the region equally often as seen from there, and at least once: a way from there, within the region,
/// to a point far away passes through a triangle.
///
/// The body is the hull of the part's own corners if that is so. Corners of a turned box are rounded, and some are in
/// front of a face by a rounding error: then all are moved towards the middle, by a 250th of the way at most.
[[nodiscard]] std::optional<std::vector<Vec3>> convex_body(const WeldedMesh& mesh, const WeldedMesh::Part& part);

/// For each part, whether another part lies wholly within it: then it is a shell, and what is in it may be seen from
/// there. False for parts that are not closed.
[[nodiscard]] std::vector<bool> shells(const WeldedMesh& mesh);

/// At most `count` of the points, far from one another: the first one, and then always the one that is farthest from
/// those before.
[[nodiscard]] std::vector<Vec3> spread_points(std::span<const Vec3> points, std::size_t count);

/// How often a closed part surrounds a point: 1 inside a body whose faces look outwards, −1 in a room whose faces look
/// inwards, 0 outside; nothing if the point is on the part, or if it is unclear. Of an open part,
/// only points in front of its open side have a number. Exact. O(triangles).
[[nodiscard]] std::optional<int> winding(const WeldedMesh& mesh, const WeldedMesh::Part& part, const Vec3& point);

}  // namespace shaftcull::kernel
