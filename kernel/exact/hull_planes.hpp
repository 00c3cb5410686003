// SPDX-License-Identifier: MIT
/// Planes through vertices of a convex hull, as exact predicates take them.
#pragma once

#include <cstdint>

#include "compiled/hull_data.hpp"
#include "exact/orientation.hpp"

namespace shaftcull::kernel {

/// Coordinate k of the way from vertex `from`, a point, to vertex `to`: a point, or a direction.
inline Step step_between(const HullData& hull, unsigned from, unsigned to, unsigned k) noexcept {
  return {hull.vertex[to][k], to < hull.points ? hull.vertex[from][k] : 0.0F};
}

/// The plane of the hull through three vertices, the first of them a point.
SpannedPlane plane_through(const HullData& hull, const std::uint8_t (&vertices)[3]) noexcept;

/// Whether all of the hull lies in one of its planes: it is flat.
[[nodiscard]] bool plane_holds_hull(const HullData& hull, unsigned number) noexcept;

/// The line through the projections of two vertices, the first of them a point, along an axis; i and j are the other
/// axes, in this order.
struct ProjectedLine {
  unsigned i;
  unsigned j;
  double point[2];
  Step along[2];

  ProjectedLine(const HullData& hull, unsigned axis, unsigned from, unsigned to) noexcept
      : i(axis == 2 ? 0 : axis + 1),
        j(axis == 0 ? 2 : axis - 1),
        point{hull.vertex[from][i], hull.vertex[from][j]},
        along{step_between(hull, from, to, i), step_between(hull, from, to, j)} {}

  /// Sign of the side of the line on which (x, y) is, x on axis i and y on axis j: positive to its right.
  [[nodiscard]] int side(double x, double y) const noexcept {
    return determinant_sign({x, point[0]}, {y, point[1]}, along[0], along[1]);
  }
  /// Likewise of a vertex of the hull, a point or a direction.
  [[nodiscard]] int side_of(const HullData& hull, unsigned vertex) const noexcept {
    const double x = hull.vertex[vertex][i];
    const double y = hull.vertex[vertex][j];
    return vertex < hull.points ? side(x, y) : determinant_sign({x, 0}, {y, 0}, along[0], along[1]);
  }
  /// Whether the line is along neither of the two axes, and is no point.
  [[nodiscard]] bool is_oblique() const noexcept { return along[0].rounded() != 0 && along[1].rounded() != 0; }
};

}  // namespace shaftcull::kernel
