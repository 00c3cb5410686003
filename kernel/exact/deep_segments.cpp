// SPDX-License-Identifier: MIT
#include "exact/deep_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

Direction way(const Direction& from, const Vec3& to) noexcept {
  return {double{to[0]} - from[0], double{to[1]} - from[1], double{to[2]} - from[2]};
}
Direction in_doubles(const Vec3& point) noexcept { return {double{point[0]}, double{point[1]}, double{point[2]}}; }
double scalar_product(const Direction& a, const Direction& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length_of(const Direction& a) noexcept { return std::sqrt(scalar_product(a, a)); }

/// The unit normal to two steps between points, off by 2⁻²² at most; 0 if it is not known as well.
Direction certain_normal(const Direction& u, const Direction& v, double coordinate) noexcept {
  const Direction n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = length_of(n);
  if (!(length > 0x1p-24 * coordinate * (length_of(u) + length_of(v)))) return {0, 0, 0};
  return {n[0] / length, n[1] / length, n[2] / length};
}

bool is_none(const Direction& n) noexcept { return n[0] == 0 && n[1] == 0 && n[2] == 0; }

}  // namespace

SegmentStart::SegmentStart(const Vec3& p, const Vec3& q, const Vec3& r, double coordinate) noexcept
    : point_{}, normal_{}, radius_(std::numeric_limits<double>::infinity()), coordinate_(coordinate) {
  for (unsigned k = 0; k != 3; ++k) point_[k] = (double{p[k]} + double{q[k]} + double{r[k]}) / 3;
  normal_ = certain_normal(way(in_doubles(p), q), way(in_doubles(p), r), coordinate);
  const Vec3 corners[] = {p, q, r, p};
  for (unsigned i = 0; i != 3; ++i) {
    const Direction edge = way(in_doubles(corners[i]), corners[i + 1]);
    const Direction to_edge = way(point_, corners[i]);
    const double along = scalar_product(edge, to_edge) / scalar_product(edge, edge);
    Direction across{};
    for (unsigned k = 0; k != 3; ++k) across[k] = to_edge[k] - along * edge[k];
    radius_ = std::min(radius_, length_of(across) * (1 - 0x1p-20));
  }
  radius_ -= 0x1p-40 * coordinate;
}

float SegmentStart::least_distance(const Vec3& end, double tolerance) const noexcept {
  constexpr float none = std::numeric_limits<float>::infinity();
  const Direction step = way(point_, end);
  const double length = length_of(step);
  const double across = std::fabs(scalar_product(normal_, step)) - 0x1p-20 * length;
  if (is_none(normal_) || !(radius_ > 0 && across > 0)) return none;
  const double height = 1.74 * tolerance + 0x1p-40 * coordinate_;
  const double least = height * length * (radius_ + 2 * length) / (radius_ * across) * (1 + 0x1p-20);
  return least < coordinate_ ? static_cast<float>(least) : none;
}

SeenTriangle seen_triangle(const Direction& from, const std::array<Vec3, 3>& triangle, double coordinate) noexcept {
  SeenTriangle seen{};
  seen.distance = -1;
  // In this range, floats neither overflow nor lose more than they round.
  if (!(coordinate > 0x1p-60 && coordinate < 0x1p60)) return seen;
  const Direction to[] = {way(from, triangle[0]), way(from, triangle[1]), way(from, triangle[2])};
  const Direction base = in_doubles(triangle[0]);
  const Direction normals[4] = {certain_normal(to[0], to[1], coordinate), certain_normal(to[1], to[2], coordinate),
                                certain_normal(to[2], to[0], coordinate),
                                certain_normal(way(base, triangle[1]), way(base, triangle[2]), coordinate)};
  if (std::any_of(std::begin(normals), std::end(normals), is_none)) return seen;
  const double beyond = scalar_product(normals[3], to[0]);  // more than 0 if edges turn left as seen from there
  const double rounding = 0x1p-18 * coordinate;
  for (unsigned i = 0; i != 4; ++i) {
    const double sign = beyond > 0 ? 1 : -1;
    for (unsigned k = 0; k != 3; ++k) seen.normal[i][k] = static_cast<float>(sign * normals[i][k]);
    const double offset = sign * scalar_product(normals[i], i == 3 ? base : from);
    seen.offset[i] = static_cast<float>(offset + rounding);
  }
  seen.distance = static_cast<float>(std::fabs(beyond) - rounding);
  return seen;
}

}  // namespace shaftcull::kernel
