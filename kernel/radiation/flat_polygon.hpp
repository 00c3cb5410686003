// SPDX-License-Identifier: MIT
/// Flat convex polygons in doubles.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

using Point = std::array<double, 3>;

[[nodiscard]] inline Point operator-(const Point& p, const Point& q) noexcept {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
[[nodiscard]] inline double dot(const Point& p, const Point& q) noexcept {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
[[nodiscard]] inline Point cross(const Point& p, const Point& q) noexcept {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

[[nodiscard]] inline double length(const Point& p) noexcept { return std::sqrt(dot(p, p)); }

/// Corners run counterclockwise as seen from the front. There may be none.
class Polygon {
 public:
  /// Most corners of a polygon that is given. Each plane that cuts it adds one.
  static constexpr std::size_t most_given = 8;

  Polygon() noexcept = default;
  /// Of 3 to most_given corners, moved and then scaled.
  Polygon(std::span<const Vec3> corners, const Point& origin, double scale) noexcept;

  [[nodiscard]] std::span<const Point> corners() const noexcept { return {corner_.data(), count_}; }
  /// Twice the area long, to the front.
  [[nodiscard]] Point normal() const noexcept;
  /// What is in front of the plane through `other`. Nothing of what only touches it.
  [[nodiscard]] Polygon in_front_of(const Polygon& other) const noexcept;
  [[nodiscard]] Polygon moved(const Point& origin, double scale) const noexcept;

 private:
  std::array<Point, most_given + 1> corner_{};
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
