// SPDX-License-Identifier: MIT
/// Patches that radiate: facets of a mesh, or pieces of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

struct FactorPatches {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};    ///< where those of each patch begin; then the last end
  std::vector<std::uint32_t> triangle;  ///< of each patch, the first triangle of its facet, in the mesh

  [[nodiscard]] std::size_t size() const noexcept { return triangle.size(); }
  [[nodiscard]] std::span<const Vec3> of(std::size_t i) const {
    return std::span(corners).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// Two triangles of an object, one after the other, that form a flat convex quadrilateral are one facet: files of
/// quadrilaterals are read as such triangles. A facet with an edge longer than `size` is cut into pieces; 0 leaves them
/// whole. Triangles without an area give none. Throws InvalidArgument for more than most_patches (patches.hpp).
[[nodiscard]] FactorPatches factor_patches(std::span<const MeshTriangle> triangles, double size);

}  // namespace shaftcull::cli
