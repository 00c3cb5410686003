// SPDX-License-Identifier: MIT
/// Open contact in exact arithmetic, straight from the definition: a bound is outside iff a plane separates it properly
/// from the shaft, that is, has them on different sides and does not hold both. Slow, and shares no code with the
/// library.
///
/// Planes separate a shaft S and a box T properly iff their normals n have n · v ≥ 0 for all v of S − T, and n · v > 0
/// for some. S and T have finitely many corners, and directions if they go on without end, so S − T has. If there is
/// such an n, then there is one that is perpendicular to enough of them to be determined by these, in the space that
/// all of them span. All of these are tried.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "oracle/convex_hull.hpp"
#include "oracle/hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::oracle {

/// A shaft with open contact, of any kind.
class OpenHull {
 public:
  explicit OpenHull(const ShaftInput& input);
  explicit OpenHull(const MovingInput& input);
  explicit OpenHull(const HullInput& input);

  /// Infinite extents, which shafts between two boxes and convex hulls may be asked about, are unbounded boxes; a box
  /// with lo > hi meets nothing.
  [[nodiscard]] Answer answer(const Box& box) const;
  /// The centre is finite, and so is the radius but for shafts between two boxes. Not for a convex hull.
  [[nodiscard]] Answer answer(const Sphere& sphere) const;
  /// Whether the triangle, of finite vertices, is outside; added planes are left out.
  [[nodiscard]] bool is_separated(const Triangle& triangle) const;

 private:
  using Point = std::array<mpq_class, 3>;
  /// A box as its lo and hi corner.
  using Corners = std::array<Point, 2>;

  [[nodiscard]] bool is_separated(const Box& box) const;
  void add_planes(const std::vector<Plane>& added);

  std::vector<Corners> boxes_;  ///< the shaft is the hull of all points of these,
  std::vector<Corners> ways_;   ///< and goes on in all directions of these
  std::vector<RationalPlane> added_;
  std::optional<Hull> between_;       ///< the same with closed contact, if it is between two boxes
  std::optional<MovingHull> moving_;  ///< likewise, if it is of a moving box
  std::optional<ConvexHull> still_;   ///< likewise, if it is a convex hull
};

/// A convex hull with open contact.
class OpenConvexHull {
 public:
  explicit OpenConvexHull(const HullInput& input) : open_(input), closed_(input) {}

  [[nodiscard]] Answer answer(const Box& box) const { return open_.answer(box); }
  [[nodiscard]] bool misses(const Triangle& triangle) const { return open_.is_separated(triangle); }
  /// As ConvexHull::corrected(). A sphere without a radius is a box, and has one answer.
  [[nodiscard]] Answer corrected(const Sphere& sphere, Answer answer) const;

 private:
  OpenHull open_;
  ConvexHull closed_;
};

}  // namespace shaftcull::oracle
