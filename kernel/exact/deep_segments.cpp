// SPDX-License-Identifier: MIT
#include "exact/deep_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

/// The unit normal to two steps between points, off by 2⁻²² at most; 0 if it is not known as well.
Double3 certain_normal(const Double3& u, const Double3& v, double coordinate) noexcept {
  const Double3 n = cross(u, v);
  const double size = length(n);
  if (!(size > 0x1p-24 * coordinate * (length(u) + length(v)))) return {0, 0, 0};
  return {n[0] / size, n[1] / size, n[2] / size};
}

bool is_none(const Double3& n) noexcept { return n[0] == 0 && n[1] == 0 && n[2] == 0; }

}  // namespace

SegmentStart::SegmentStart(const Vec3& p, const Vec3& q, const Vec3& r, double coordinate) noexcept
    : point_{}, normal_{}, radius_(std::numeric_limits<double>::infinity()), coordinate_(coordinate) {
  for (unsigned k = 0; k != 3; ++k) point_[k] = (double{p[k]} + double{q[k]} + double{r[k]}) / 3;
  normal_ = certain_normal(between(p, q), between(p, r), coordinate);
  const Vec3 corners[] = {p, q, r, p};
  for (unsigned i = 0; i != 3; ++i) {
    const Double3 edge = between(corners[i], corners[i + 1]);
    const Double3 to_edge = in_doubles(corners[i]) - point_;
    const double along = dot(edge, to_edge) / dot(edge, edge);
    Double3 across{};
    for (unsigned k = 0; k != 3; ++k) across[k] = to_edge[k] - along * edge[k];
    radius_ = std::min(radius_, length(across) * (1 - 0x1p-20));
  }
  radius_ -= 0x1p-40 * coordinate;
}

float SegmentStart::least_distance(const Vec3& end, double tolerance) const noexcept {
  constexpr float none = std::numeric_limits<float>::infinity();
  const Double3 step = in_doubles(end) - point_;
  const double far = length(step);
  const double across = std::fabs(dot(normal_, step)) - 0x1p-20 * far;
  if (is_none(normal_) || !(radius_ > 0 && across > 0)) return none;
  const double height = 1.74 * tolerance + 0x1p-40 * coordinate_;
  const double least = height * far * (radius_ + 2 * far) / (radius_ * across) * (1 + 0x1p-20);
  return least < coordinate_ ? static_cast<float>(least) : none;
}

SeenTriangle seen_triangle(const Double3& from, const std::array<Vec3, 3>& triangle, double coordinate) noexcept {
  SeenTriangle seen{};
  seen.distance = -1;
  // In this range, floats neither overflow nor lose more than they round.
  if (!(coordinate > 0x1p-60 && coordinate < 0x1p60)) return seen;
  const Double3 to[] = {in_doubles(triangle[0]) - from, in_doubles(triangle[1]) - from, in_doubles(triangle[2]) - from};
  const Double3 base = in_doubles(triangle[0]);
  const Double3 normals[4] = {
      certain_normal(to[0], to[1], coordinate), certain_normal(to[1], to[2], coordinate),
      certain_normal(to[2], to[0], coordinate),
      certain_normal(between(triangle[0], triangle[1]), between(triangle[0], triangle[2]), coordinate)};
  if (std::any_of(std::begin(normals), std::end(normals), is_none)) return seen;
  const double beyond = dot(normals[3], to[0]);  // more than 0 if edges turn left as seen from there
  const double rounding = 0x1p-18 * coordinate;
  for (unsigned i = 0; i != 4; ++i) {
    const double sign = beyond > 0 ? 1 : -1;
    for (unsigned k = 0; k != 3; ++k) seen.normal[i][k] = static_cast<float>(sign * normals[i][k]);
    const double offset = sign * dot(normals[i], i == 3 ? base : from);
    seen.offset[i] = static_cast<float>(offset + rounding);
  }
  seen.distance = static_cast<float>(std::fabs(beyond) - rounding);
  return seen;
}

}  // namespace shaftcull::kernel
