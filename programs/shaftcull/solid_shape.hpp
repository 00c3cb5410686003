// SPDX-License-Identifier: MIT
/// Objects of a mesh that can be taken for solid: convex bodies.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh.hpp"

namespace shaftcull::cli {

/// What an object is as a solid.
struct SolidShape {
  std::vector<Vec3> corners;  ///< those of its convex hull; vertices within its edges and faces are left out
  bool is_box = false;        ///< it is the box around it
  bool is_dented = false;     ///< some triangles have corners on both sides; `corners` are moved until none have
  std::string refusal;        ///< why it is no solid: "it is not closed"; empty if it is one
};

/// The shape of an object with these triangles: a closed surface, each of whose triangles has all of the object on one
/// side, but for a ten-thousandth of its size.
[[nodiscard]] SolidShape solid_shape(std::span<const MeshTriangle> triangles);

}  // namespace shaftcull::cli
