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

double dot_product(const Direction& a, const Direction& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Direction cross_product(const Direction& a, const Direction& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Direction difference(const Vec3& a, const Vec3& b) noexcept {
  return {double{a[0]} - b[0], double{a[1]} - b[1], double{a[2]} - b[2]};
}

/// What of a direction is across a normal, of unit length; 0 if that is so little that it would not be orthogonal.
Direction across(const Direction& normal, const Direction& direction) noexcept {
  const Direction to = unit(direction);
  const double share = dot_product(to, normal);
  const Direction rest{to[0] - share * normal[0], to[1] - share * normal[1], to[2] - share * normal[2]};
  return dot_product(rest, rest) > 1.0 / 64 ? unit(rest) : Direction{0, 0, 0};
}

TurnedBox box_along(const std::array<Direction, 3>& axis, std::span<const Vec3> points, std::size_t step) noexcept {
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

double component(const Direction& direction, const Vec3& point) noexcept {
  return direction[0] * point[0] + direction[1] * point[1] + direction[2] * point[2];
}

Direction unit(const Direction& direction) noexcept {
  const double length = std::sqrt(dot_product(direction, direction));
  if (!(length > 0x1p-500)) return {0, 0, 0};
  return {direction[0] / length, direction[1] / length, direction[2] / length};
}

double TurnedBox::farthest(const Direction& direction) const noexcept {
  double sum = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const double share = dot_product(direction, axis[k]);
    sum += std::max(share * lo[k], share * hi[k]);
  }
  return sum;
}

TurnedBox turned_box(std::span<const Vec3> points, const Direction& normal, std::span<const Direction> edges) noexcept {
  constexpr std::size_t few = 128;  // points show which edge is best
  const std::size_t step = points.size() / few + 1;
  std::array<Direction, 3> best{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double smallest = no_bound;
  const auto try_edge = [&](const Direction& edge) {
    const Direction one = across(normal, edge);
    if (dot_product(one, one) == 0) return;
    const std::array<Direction, 3> axis{one, cross_product(normal, one), normal};
    const TurnedBox box = box_along(axis, points, step);
    const double area = (box.hi[0] - box.lo[0]) * (box.hi[1] - box.lo[1]);
    if (area >= smallest) return;
    smallest = area;
    best = axis;
  };
  if (dot_product(normal, normal) != 0) {
    for (const Direction& edge : edges) try_edge(edge);
    for (std::size_t k = 0; k != 3 && smallest == no_bound; ++k) {
      Direction edge{};
      edge[k] = 1;
      try_edge(edge);
    }
  }
  return box_along(best, points, 1);
}

TurnedBox turned_box(std::span<const Vec3> points) noexcept {
  const auto length = [](const Direction& d) { return dot_product(d, d); };
  const Vec3& p = points.front();
  const Vec3 q = farthest_point(points, [&](const Vec3& x) { return length(difference(x, p)); });
  const Direction diagonal = difference(q, p);
  const Vec3 r =
      farthest_point(points, [&](const Vec3& x) { return length(cross_product(diagonal, difference(x, p))); });
  const Direction edges[] = {difference(r, p), difference(r, q), diagonal};
  return turned_box(points, unit(cross_product(unit(diagonal), unit(difference(r, p)))), edges);
}

}  // namespace shaftcull::kernel
