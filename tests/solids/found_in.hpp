// SPDX-License-Identifier: MIT
/// What find_solids() finds in a mesh, for tests.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "shaftcull/solids.hpp"
#include "solids/meshes.hpp"

namespace shaftcull {

inline FoundSolids found_in(const Polygons& mesh, const SolidSearch& search = {}) {
  return find_solids(TriangleStream(std::span<const Triangle>(mesh.triangles)), search);
}

inline std::vector<Vec3> hull(const FoundSolids& found, std::size_t i) {
  return {found.hull_corners.begin() + static_cast<std::ptrdiff_t>(found.first_hull_corner[i]),
          found.hull_corners.begin() + static_cast<std::ptrdiff_t>(found.first_hull_corner[i + 1])};
}

/// How many hulls, polygons and inner boxes there are.
using Counts = std::array<std::size_t, 3>;
inline Counts counts(const FoundSolids& found) { return {found.hulls(), found.polygons(), found.inner_boxes.size()}; }

}  // namespace shaftcull
