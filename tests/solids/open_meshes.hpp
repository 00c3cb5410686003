// SPDX-License-Identifier: MIT
/// Meshes of buildings without a bottom.
#pragma once

#include "shaftcull/bounds.hpp"
#include "solids/meshes.hpp"

namespace shaftcull {

/// A box without its bottom.
inline void add_open_box(Polygons& to, const Box& box) {
  to.add_box(box);
  to.triangles.resize(to.triangles.size() - 2);
}

/// Ground of 6 × 6 squares of 10 m, and four buildings without bottoms on it. Where they stand there is no ground, and
/// they share edges with the ground around them. One stands at the rim.
inline Polygons city_on_level_ground() {
  Polygons mesh;
  const auto is_built = [](int x, int y) { return (x == 1 || x == 5) && (y == 1 || y == 3); };
  for (int x = 0; x != 6; ++x) {
    for (int y = 0; y != 6; ++y) {
      const auto at_x = static_cast<float>(10 * x);
      const auto at_y = static_cast<float>(10 * y);
      if (is_built(x, y)) {
        add_open_box(mesh, {{at_x, at_y, 0}, {at_x + 10, at_y + 10, at_x + at_y}});
      } else {
        mesh.add({{at_x, at_y, 0}, {at_x + 10, at_y, 0}, {at_x + 10, at_y + 10, 0}, {at_x, at_y + 10, 0}});
      }
    }
  }
  return mesh;
}

}  // namespace shaftcull
