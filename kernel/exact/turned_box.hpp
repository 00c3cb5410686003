// SPDX-License-Identifier: MIT
/// Boxes with sides along any three orthogonal directions, in doubles, around points.
#pragma once

#include <array>
#include <span>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

using Direction = std::array<double, 3>;

/// Points whose components along three axes are from lo to hi. The axes are orthonormal but for 2⁻⁴⁴. No coordinate of
/// a point is larger than `size`.
struct TurnedBox {
  std::array<Direction, 3> axis;
  Direction lo;
  Direction hi;
  double size;

  /// The largest component of a point along a direction, or more, but for 2⁻⁴⁰ of `size` times the direction's length.
  [[nodiscard]] double farthest(const Direction& direction) const noexcept;
};

[[nodiscard]] double component(const Direction& direction, const Vec3& point) noexcept;
/// Of unit length, or 0 if the length is next to 0.
[[nodiscard]] Direction unit(const Direction& direction) noexcept;

/// A box around one point or more. One side is along `normal`, of length 1 or 0, and another one along what of an edge
/// is across it, of the edge that makes the box smallest. O(points).
[[nodiscard]] TurnedBox turned_box(std::span<const Vec3> points, const Direction& normal,
                                   std::span<const Direction> edges) noexcept;
/// A box around one point or more that is flat if the points are, and no larger than they are if these fill a rectangle
/// and the first one is a corner of it.
[[nodiscard]] TurnedBox turned_box(std::span<const Vec3> points) noexcept;

}  // namespace shaftcull::kernel
