// SPDX-License-Identifier: MIT
/// Whether a segment crosses triangles, in rational arithmetic.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "oracle/blocking.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {

using oracle::RationalPoint;

inline RationalPoint exactly(const Vec3& point) {
  return {mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])};
}

inline RationalPoint minus(const RationalPoint& p, const RationalPoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

/// The sign of the volume of four points.
inline int orientation(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c, const RationalPoint& d) {
  const RationalPoint u = minus(b, a);
  const RationalPoint v = minus(c, a);
  const RationalPoint w = minus(d, a);
  const mpq_class volume =
      (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
  return sgn(volume);
}

/// Whether a segment that is not in the plane of a triangle meets it.
inline bool crosses(const RationalPoint& from, const RationalPoint& to, const Triangle& triangle) {
  std::array<RationalPoint, 3> corner;
  for (std::size_t i = 0; i != 3; ++i) corner[i] = exactly(triangle.vertex[i]);
  const int of_from = orientation(corner[0], corner[1], corner[2], from);
  const int of_to = orientation(corner[0], corner[1], corner[2], to);
  if (of_from == of_to) return false;  // on one side; or both in the plane, or there is none
  std::array<int, 3> past{};
  for (std::size_t i = 0; i != 3; ++i) past[i] = orientation(from, to, corner[i], corner[(i + 1) % 3]);
  const auto [least, most] = std::minmax_element(past.begin(), past.end());
  return *least >= 0 || *most <= 0;
}

inline bool crosses(const RationalPoint& from, const RationalPoint& to, std::span<const Triangle> triangles) {
  return std::any_of(triangles.begin(), triangles.end(),
                     [&](const Triangle& triangle) { return crosses(from, to, triangle); });
}

}  // namespace shaftcull
