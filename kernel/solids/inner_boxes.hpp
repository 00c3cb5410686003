// SPDX-License-Identifier: MIT
/// Boxes inside closed parts of a mesh.
#pragma once

#include <vector>

#include "shaftcull/bounds.hpp"
#include "solids/welded_mesh.hpp"

namespace shaftcull::kernel {

/// Boxes inside a closed part whose faces look outwards, largest first; there may be larger ones. They are made of
/// cells of a grid through the part's vertices: 64 cells, two more for each triangle, 4,096 at most.
///
/// The proof: no triangle of the part reaches into an open cell, by the exact test of triangles, and the part surrounds
/// a point of it. So it surrounds all of the cell, and a way from there to a point far away passes through a triangle.
/// A box is a union of such cells.
[[nodiscard]] std::vector<Box> inner_boxes(const WeldedMesh& mesh, const WeldedMesh::Part& part);

}  // namespace shaftcull::kernel
