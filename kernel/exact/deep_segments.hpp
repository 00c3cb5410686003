// SPDX-License-Identifier: MIT
/// Segments that certainly pass through a triangle deep inside the shaft between two patches. Then no plane that
/// touches both patches has the triangle behind it, and the triangle's own plane has a patch on each side.
///
/// Let A be a triangle between corners of the first patch, o its centroid, r the radius of its inscribed circle about
/// o, and m its unit normal; e a point of the second patch, L = |e − o|, and D = |m·(e − o)|. A plane that touches both
/// patches, with both in front, has a unit normal n at some angle to m, of sine s. Let h be heights above it.
///
/// * The circle is in front, so h(o) ≥ r s.
/// * h(o) + h(e) ≥ |h(e) − h(o)| = |n·(e − o)| ≥ (1 − s) D − s L.
///
/// One of them is at least r D / (r + D + L) ≥ r D / (r + 2 L), whatever s is. If the segment from o to e meets the
/// triangle in y, and o and e are at least d away from the triangle's plane, then
///
///   h(y) ≥ d / L · (h(o) + h(e)) ≥ d r D / (L (r + 2 L)).
///
/// A vertex of the triangle is as high. So it is in front by more than the tolerance t, which lowers heights by √3 t at
/// most, if d is more than √3 t L (r + 2 L) / (r D). (docs/exactness.md has the rounding.)
#pragma once

#include <array>

#include "exact/turned_box.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Where segments begin: the centroid of a triangle.
class SegmentStart {
 public:
  /// No coordinate is larger than `coordinate`.
  SegmentStart(const Vec3& p, const Vec3& q, const Vec3& r, double coordinate) noexcept;

  [[nodiscard]] const Double3& point() const noexcept { return point_; }
  /// How far both ends of a segment must be from a triangle's plane, in order that the triangle is in front of all
  /// planes that touch both patches by more than the tolerance. Infinite if that is not known.
  [[nodiscard]] float least_distance(const Vec3& end, double tolerance) const noexcept;

 private:
  Double3 point_;
  Double3 normal_;  ///< of length 1, or 0 if it is not known well
  double radius_;
  double coordinate_;
};

/// A triangle as seen from a point. A segment from there to e passes through it if offset ≤ normal·e for the planes
/// through the point and an edge, and for the triangle's own plane. That leaves room for rounding. The segment's ends
/// are at least d from the triangle's plane if d ≤ distance and offset[3] + d ≤ normal[3]·e.
struct SeenTriangle {
  float normal[4][3];
  float offset[4];
  float distance;  ///< negative if nothing is certain
};
[[nodiscard]] SeenTriangle seen_triangle(const Double3& from, const std::array<Vec3, 3>& triangle,
                                         double coordinate) noexcept;

}  // namespace shaftcull::kernel
