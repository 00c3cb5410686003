// SPDX-License-Identifier: MIT
#include "exact/turned_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

/// What of a direction is across a normal, of unit length; 0 if that is so little that it would not be orthogonal.
Double3 across(const Double3& normal, const Double3& direction) noexcept {
  const Double3 to = unit(direction);
  const double share = dot(to, normal);
  const Double3 rest{to[0] - share * normal[0], to[1] - share * normal[1], to[2] - share * normal[2]};
  return dot(rest, rest) > 1.0 / 64 ? unit(rest) : Double3{0, 0, 0};
}

TurnedBox box_along(const std::array<Double3, 3>& axis, std::span<const Vec3> points, std::size_t step) noexcept {
  TurnedBox box{axis, {no_bound, no_bound, no_bound}, {-no_bound, -no_bound, -no_bound}, 0};
  for (std::size_t i = 0; i < points.size(); i += step) {
    for (std::size_t k = 0; k != 3; ++k) {
      const double at = component(axis[k], points[i]);
      box.lo[k] = std::min(box.lo[k], at);
      box.hi[k] = std::max(box.hi[k], at);
      box.size = std::max(box.size, std::fabs(double{points[i][k]}));
    }
  }
  return box;
}

/// The point for which far() is largest.
template <class Far>
Vec3 farthest_point(std::span<const Vec3> points, const Far& far) noexcept {
  return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return far(a) < far(b); });
}

}  // namespace

double component(const Double3& direction, const Vec3& point) noexcept {
  return direction[0] * point[0] + direction[1] * point[1] + direction[2] * point[2];
}

Double3 unit(const Double3& direction) noexcept {
  const double size = length(direction);
  if (!(size > 0x1p-500)) return {0, 0, 0};
  return {direction[0] / size, direction[1] / size, direction[2] / size};
}

double TurnedBox::farthest(const Double3& direction) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const double share = dot(direction, axis[k]);
    sum += std::max(share * lo[k], share * hi[k]);
  }
  return sum;
}

TurnedBox turned_box(std::span<const Vec3> points, const Double3& normal, std::span<const Double3> edges) noexcept {
  constexpr std::size_t few = 128;  // points show which edge is best
  const std::size_t step = points.size() / few + 1;
  std::array<Double3, 3> best{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double smallest = no_bound;
  const auto try_edge = [&](const Double3& edge) {
    const Double3 one = across(normal, edge);
    if (dot(one, one) == 0) return;
    const std::array<Double3, 3> axis{one, cross(normal, one), normal};
    const TurnedBox box = box_along(axis, points, step);
    const double area = (box.hi[0] - box.lo[0]) * (box.hi[1] - box.lo[1]);
    if (area >= smallest) return;
    smallest = area;
    best = axis;
  };
  if (dot(normal, normal) != 0) {
    for (const Double3& edge : edges) try_edge(edge);
    for (std::size_t k = 0; k != 3 && smallest == no_bound; ++k) {
      Double3 edge{};
      edge[k] = 1;
      try_edge(edge);
    }
  }
  return box_along(best, points, 1);
}

TurnedBox turned_box(std::span<const Vec3> points) noexcept {
  const auto squared = [](const Double3& d) { return dot(d, d); };
  const Vec3& p = points.front();
  const Vec3 q = farthest_point(points, [&](const Vec3& x) { return squared(between(p, x)); });
  const Double3 diagonal = between(p, q);
  const Vec3 r = farthest_point(points, [&](const Vec3& x) { return squared(cross(diagonal, between(p, x))); });
  const Double3 edges[] = {between(p, r), between(q, r), diagonal};
  return turned_box(points, unit(cross(unit(diagonal), unit(between(p, r)))), edges);
}

}  // namespace shaftcull::kernel
