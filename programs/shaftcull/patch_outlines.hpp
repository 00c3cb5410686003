// SPDX-License-Identifier: MIT
/// Patches of a mesh as polygons, as the library takes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh.hpp"
#include "patches.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::cli {

/// Polygons, by their corners.
struct PatchOutlines {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first;  ///< where those of each patch begin, then where the last ones end
  bool are_boxes = true;           ///< whether each is the box around it

  [[nodiscard]] bool empty() const noexcept { return corners.empty(); }
  /// Some of them as a set.
  [[nodiscard]] PatchSet set_of(std::span<const std::uint32_t> some, PatchSides sides) const;
};

/// The outlines of patches, each with the box around it: three corners, rounded to floats. A patch of a rectangle
/// across an axis has the four corners of the box around it, which lies within the rectangle: such patches are compared
/// much faster.
[[nodiscard]] PatchOutlines outlines_of(std::span<const MeshTriangle> triangles, std::span<const MeshPatch> patches,
                                        std::span<const Box> boxes);

}  // namespace shaftcull::cli
