// SPDX-License-Identifier: MIT
#include "exact/hull_triangle.hpp"

#include <cmath>

#include "exact/hull_planes.hpp"
#include "exact/orientation.hpp"
#include "exact/sides.hpp"

namespace shaftcull::kernel {
namespace {

/// Whether a plane that a convex hull and a triangle touch, or one of them, parts them: both are on its sides, and do
/// not both reach it, or with open contact do not both lie in it. Directions of the hull count as points far away: they
/// reach no plane.
bool are_parted(Contact contact, const Sides& points, const Sides& directions, const Sides& triangle) noexcept {
  const bool hull_in_front = points.in_front || directions.in_front;
  const bool hull_behind = points.behind || directions.behind;
  if ((hull_in_front && (hull_behind || triangle.in_front)) || (hull_behind && triangle.behind) || triangle.are_mixed())
    return false;
  if (contact == Contact::open) return hull_in_front || hull_behind || triangle.in_front || triangle.behind;
  return !points.in_plane || !triangle.in_plane;
}

class TriangleAndHull {
 public:
  TriangleAndHull(const HullData& hull, Contact contact, const float (&triangle)[9]) noexcept
      : hull_(hull), contact_(contact), x_(triangle) {}

  /// Whether any plane that may part them does. docs/exactness.md says why no others need be tried.
  [[nodiscard]] bool are_apart() const noexcept {
    return by_box() || by_planes() || by_triangle() || by_edges_and_axes() || by_edges();
  }

 private:
  [[nodiscard]] Step of_edge(unsigned e, unsigned k) const noexcept {
    return {x_[3 * ((e + 1) % 3) + k], x_[3 * e + k]};
  }

  /// Faces of the hull's box, which may be infinite.
  [[nodiscard]] bool by_box() const noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      for (const unsigned f : {k, k + 3}) {
        const float face = hull_.box[f];
        if (std::isinf(face)) continue;
        const int outwards = f < 3 ? -1 : 1;
        Sides triangle;
        for (unsigned v = 0; v < 3; ++v) {
          const float x = x_[3 * v + k];
          triangle.add(x > face ? outwards : x < face ? -outwards : 0);
        }
        if (are_parted_by(triangle, hull_.box[k] == hull_.box[k + 3])) return true;
      }
    }
    return false;
  }

  /// The hull's planes.
  [[nodiscard]] bool by_planes() const noexcept {
    for (unsigned number = 0; number < hull_.faces + hull_.edges; ++number) {
      const HullData::Plane& plane = hull_.plane[number];
      Sides triangle;
      if (number < hull_.faces) {
        const SpannedPlane face = plane_through(hull_, plane.vertices);
        for (unsigned v = 0; v < 3; ++v) triangle.add(plane.sign * face.side({x(v, 0), x(v, 1), x(v, 2)}));
      } else {
        const ProjectedLine line(hull_, plane.axis, plane.vertices[0], plane.vertices[1]);
        for (unsigned v = 0; v < 3; ++v) triangle.add(plane.sign * line.side(x(v, line.i), x(v, line.j)));
      }
      if (triangle.behind) continue;
      const bool holds_hull = contact_ == Contact::open && !triangle.in_front && plane_holds_hull(hull_, number);
      if (are_parted_by(triangle, holds_hull)) return true;
    }
    return false;
  }

  /// Whether a plane that the hull touches from behind parts them.
  [[nodiscard]] bool are_parted_by(const Sides& triangle, bool holds_hull) const noexcept {
    if (triangle.behind) return false;
    return contact_ == Contact::open ? triangle.in_front || !holds_hull : !triangle.in_plane;
  }

  /// The triangle's plane.
  [[nodiscard]] bool by_triangle() const noexcept {
    const Step u[3] = {of_edge(0, 0), of_edge(0, 1), of_edge(0, 2)};
    const Step v[3] = {of_edge(1, 0), of_edge(1, 1), of_edge(1, 2)};
    Sides triangle;
    triangle.add(0);
    return is_parted_by(SpannedPlane({x(0, 0), x(0, 1), x(0, 2)}, u, v), triangle);
  }

  /// Planes along an edge of the triangle and an axis: for hulls without an interior.
  [[nodiscard]] bool by_edges_and_axes() const noexcept {
    if (hull_.facets != 0) return false;
    for (unsigned e = 0; e < 3; ++e) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        const Step along[3] = {{axis == 0 ? 1.0 : 0.0, 0}, {axis == 1 ? 1.0 : 0.0, 0}, {axis == 2 ? 1.0 : 0.0, 0}};
        if (by_edge_and(e, along)) return true;
      }
    }
    return false;
  }

  /// Planes along an edge of the triangle and one of the hull.
  [[nodiscard]] bool by_edges() const noexcept {
    if (hull_.facets != 0) {
      for (unsigned c = 0; c < hull_.creases; ++c) {
        if (by_hull_edge(hull_.crease[c].from, hull_.crease[c].to)) return true;
      }
      return false;
    }
    for (unsigned p = 0; p < hull_.points; ++p) {
      for (unsigned q = p + 1; q < hull_.vertices; ++q) {
        if (by_hull_edge(p, q)) return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool by_hull_edge(unsigned from, unsigned to) const noexcept {
    const Step along[3] = {step_between(hull_, from, to, 0), step_between(hull_, from, to, 1),
                           step_between(hull_, from, to, 2)};
    return by_edge_and(0, along) || by_edge_and(1, along) || by_edge_and(2, along);
  }

  /// The plane through edge e of the triangle and the one through a vertex of the hull that is nearest to it, along
  /// some vector: the hull must be on one side of the first, if a plane along both parts them.
  [[nodiscard]] bool by_edge_and(unsigned e, const Step (&along)[3]) const noexcept {
    const Step edge[3] = {of_edge(e, 0), of_edge(e, 1), of_edge(e, 2)};
    const unsigned other = (e + 2) % 3;
    const SpannedPlane plane({x(e, 0), x(e, 1), x(e, 2)}, edge, along);
    Sides triangle;
    triangle.add(0);
    triangle.add(plane.side({x(other, 0), x(other, 1), x(other, 2)}));
    return is_parted_by(plane, triangle);
  }

  [[nodiscard]] bool is_parted_by(const SpannedPlane& plane, const Sides& triangle) const noexcept {
    Sides points;
    Sides directions;
    for (unsigned v = 0; v < hull_.vertices; ++v) {
      const double at[3] = {hull_.vertex[v][0], hull_.vertex[v][1], hull_.vertex[v][2]};
      if (v < hull_.points) {
        points.add(plane.side(at));
      } else {
        directions.add(plane.sign_along({{at[0], 0}, {at[1], 0}, {at[2], 0}}));
      }
      if (points.are_mixed() || (points.in_front && triangle.in_front) || (points.behind && triangle.behind))
        return false;
    }
    return are_parted(contact_, points, directions, triangle);
  }

  [[nodiscard]] double x(unsigned v, unsigned k) const noexcept { return x_[3 * v + k]; }

  const HullData& hull_;
  Contact contact_;
  const float (&x_)[9];
};

}  // namespace

bool triangle_misses_hull(const HullData& hull, Contact contact, const float (&triangle)[9]) noexcept {
  for (const float coordinate : triangle) {
    if (!std::isfinite(coordinate)) return false;
  }
  return TriangleAndHull(hull, contact, triangle).are_apart();
}

}  // namespace shaftcull::kernel
