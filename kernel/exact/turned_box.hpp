// SPDX-License-Identifier: MIT
/// Boxes with sides along any three orthogonal directions, in doubles, around points.
#pragma once

#include <array>
#include <span>

#include "shaftcull/bounds.hpp"
#include "support/double3.hpp"

namespace shaftcull::kernel {

/// Points whose components along three axes are from lo to hi. The axes are orthonormal but for 2⁻⁴⁴. No coordinate of
/// a point is larger than `size`.
struct TurnedBox {
  std::array<Double3, 3> axis;
  Double3 lo;
  Double3 hi;
  double size;

  /// The largest component of a point along a direction, or more, but for 2⁻⁴⁰ of `size` times the direction's length.
  [[nodiscard]] double farthest(const Double3& direction) const noexcept;
};

[[nodiscard]] double component(const Double3& direction, const Vec3& point) noexcept;
/// Of unit length, or 0 if the length is next to 0.
[[nodiscard]] Double3 unit(const Double3& direction) noexcept;

/// A box around one point or more. One side is along `normal`, of length 1 or 0, and another one along what of an edge
/// is across it, of the edge that makes the box smallest. O(points).
[[nodiscard]] TurnedBox turned_box(std::span<const Vec3> points, const Double3& normal,
                                   std::span<const Double3> edges) noexcept;
/// A box around one point or more that is flat if the points are, and no larger than they are if these fill a rectangle
/// and the first one is a corner of it.
[[nodiscard]] TurnedBox turned_box(std::span<const Vec3> points) noexcept;

}  // namespace shaftcull::kernel
