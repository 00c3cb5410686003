// SPDX-License-Identifier: MIT
/// Answers of convex hulls, worked out in exact rational arithmetic. Shares no code with the library.
///
/// Two convex polyhedra, of which one is bounded, have no point in common iff a plane separates them that is parallel
/// to a face of one of them, or to an edge of each. The other one being a box, that is a plane through three vertices
/// of the hull, through two of them and parallel to an axis, or perpendicular to an axis. All of them are tried, those
/// that are no faces and edges of the hull, too. With a triangle, planes parallel to it, or to an edge of it and any
/// two vertices of the hull or an axis, are tried as well.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {

/// A convex hull, as what its constructor is given: conv(points) + cone(directions).
struct HullInput {
  std::vector<Vec3> points{};
  std::vector<Vec3> directions{};
  Contact contact = Contact::closed;
  std::size_t first_end = 0;  ///< how many of the points are one of two ends; 0 if there are no two
};

/// C++ source text that makes the same values again, to the bit.
std::string source_text(const HullInput& input);

namespace oracle {

class ConvexHull {
 public:
  explicit ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions = {});
  explicit ConvexHull(const HullInput& input) : ConvexHull(input.points, input.directions) {}

  /// Infinite extents are unbounded boxes; a box with lo > hi meets nothing.
  [[nodiscard]] Answer answer(const Box& box) const;

  /// Whether a triangle, of finite vertices, has no point in common with the hull.
  [[nodiscard]] bool misses(const Triangle& triangle) const;

  /// Whether the sphere, with a finite centre and radius, is beyond one of the planes that are spanned by more than its
  /// radius times 1 + `slack`, and `slack` of its coordinates and the largest of the hull's; with open contact, by as
  /// much.
  [[nodiscard]] bool is_beyond(const Sphere& sphere, double slack = 0, Contact contact = Contact::closed) const;
  /// Whether it is behind all of them by its radius, likewise.
  [[nodiscard]] bool is_within(const Sphere& sphere, double slack = 0) const;

  /// About the radius at which a sphere around `centre` comes to touch the plane that decides about it, from outside or
  /// from inside.
  [[nodiscard]] double distance_to_surface(const Vec3& centre) const;

  /// An answer about a sphere if it may be given, else what it should have been. Outside must be beyond a plane, inside
  /// behind all of them. What of this holds by more than rounding must be seen.
  /// With open contact, the sphere has a radius, and one that touches a face of the hull's box is outside.
  [[nodiscard]] Answer corrected(const Sphere& sphere, Answer answer, Contact contact = Contact::closed) const;

 private:
  using Vector = std::array<mpq_class, 3>;
  /// normal·p ≤ offset for all points of the hull, with equality for one.
  struct Plane {
    Vector normal;
    mpq_class offset;
    bool is_spanned;  ///< by a face of the hull, an edge that it shows along an axis, or a face of its box
  };

  /// Adds the planes with this normal that touch the hull from either side. `through` is a point of what spans them, or
  /// null for faces of the hull's box.
  void add_planes(const Vector& normal, const Vector* through);

  /// Whether a sphere touches a face of the box around the hull from outside.
  [[nodiscard]] bool touches_box(const Sphere& sphere) const;

  std::vector<Vector> points_;
  Vector largest_;  ///< magnitude of a coordinate of theirs
  std::vector<Vector> directions_;
  std::vector<Plane> planes_;
};

}  // namespace oracle
}  // namespace shaftcull
