// SPDX-License-Identifier: MIT
/// Where shafts are, for pictures: in doubles, and only as right as a picture has to be.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "shaft_choice.hpp"

namespace shaftcull::cli {

using Point3 = std::array<double, 3>;
using Point2 = std::array<double, 2>;

/// All that is reached from the convex hull of `points` along `directions`.
struct Region {
  std::vector<Point3> points;
  std::vector<Point3> directions;
};

/// The region of the shaft of boxes `from` and `to`; neither is read where the kind has no such end.
[[nodiscard]] Region region_of(const ShaftChoice& choice, const Box& from, const Box& to);

/// The part of space that a picture shows.
struct ShownSpace {
  Point3 lo;
  Point3 hi;

  [[nodiscard]] double extent(std::size_t axis) const { return hi[axis] - lo[axis]; }
  [[nodiscard]] double middle(std::size_t axis) const { return (lo[axis] + hi[axis]) / 2; }
};

/// The least frame around points, of the region and others, and around a way in each direction that is as long as these
/// are wide.
[[nodiscard]] ShownSpace frame_around(const Region& region, std::span<const Point3> others);

[[nodiscard]] Point3 corner_of(const Box& box, unsigned corner);
[[nodiscard]] Point3 in_doubles(const Vec3& v);

/// The corners of the convex hull, counterclockwise.
[[nodiscard]] std::vector<Point2> hull_outline(std::vector<Point2> points);

/// Whether a convex polygon, its edges included, has a point in common with the rectangle between two corners. It may
/// be a segment or a point.
[[nodiscard]] bool meets_rectangle(const std::vector<Point2>& polygon, const Point2& lo, const Point2& hi);

/// The outline of the region as it is seen along the third axis, cut off where the frame ends. Counterclockwise; empty
/// if the frame shows none of it.
[[nodiscard]] std::vector<Point2> outline_of(const Region& region, const ShownSpace& frame, std::size_t across,
                                             std::size_t up);

}  // namespace shaftcull::cli
