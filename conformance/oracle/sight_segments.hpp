// SPDX-License-Identifier: MIT
/// Segments between two patches of the oracle, and what all of them pass through. `Number` is an integer type that does
/// not overflow; a `Coordinate` is that, or infinitely little more or less.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "oracle/sight_numbers.hpp"

namespace shaftcull::oracle {

template <class Number>
struct BoxOf {
  PointOf<Number> lo;
  PointOf<Number> hi;

  [[nodiscard]] bool is_flat(std::size_t k) const { return lo[k] == hi[k]; }
  [[nodiscard]] PointOf<Number> corner(unsigned c) const {
    PointOf<Number> point;
    for (unsigned k = 0; k != 3; ++k) point[k] = (c >> k & 1U) != 0 ? hi[k] : lo[k];
    return point;
  }
  /// All corners, each once.
  [[nodiscard]] std::vector<PointOf<Number>> corners() const {
    std::vector<PointOf<Number>> corners;
    for (unsigned c = 0; c != 8; ++c) {
      bool is_new = true;
      for (unsigned k = 0; k != 3; ++k) is_new = is_new && ((c >> k & 1U) == 0 || !is_flat(k));
      if (is_new) corners.push_back(corner(c));
    }
    return corners;
  }
};

template <class Number>
[[nodiscard]] Number dot(const PointOf<Number>& p, const PointOf<Number>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
template <class Coordinate>
[[nodiscard]] PointOf<Coordinate> minus(const PointOf<Coordinate>& p, const PointOf<Coordinate>& q) {
  return {Coordinate(p[0] - q[0]), Coordinate(p[1] - q[1]), Coordinate(p[2] - q[2])};
}
template <class Coordinate>
[[nodiscard]] Coordinate determinant(const PointOf<Coordinate>& p, const PointOf<Coordinate>& q,
                                     const PointOf<Coordinate>& r) {
  return p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}
template <class Coordinate, class Number>
[[nodiscard]] PointOf<Coordinate> as(const PointOf<Number>& p) {
  return {Coordinate(p[0]), Coordinate(p[1]), Coordinate(p[2])};
}

/// A corner moved by n ε of its way to the middle of all n corners: into the relative interior of their hull.
template <class Number>
[[nodiscard]] PointOf<Infinitesimal<Number>> inner(const PointOf<Number>& corner,
                                                   const std::vector<PointOf<Number>>& corners) {
  const auto coordinate = [&](std::size_t k) {
    Number way = 0;
    for (const PointOf<Number>& other : corners) way += other[k] - corner[k];
    return Infinitesimal<Number>(corner[k], way);
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

/// Whether all segments between the relative interiors of two hulls pass. These are the unions of the hulls shrunk
/// towards their middles, by however little, and of a shrunk hull the corners decide. If `is_open`, points near those
/// of a segment that passes have segments that pass, and points near those of a segment that `misses` have segments
/// that do not pass, so most corners need not be moved.
template <class Number, class Misses, class Passes>
[[nodiscard]] bool all_segments(const std::vector<PointOf<Number>>& a, const std::vector<PointOf<Number>>& b,
                                bool is_open, const Misses& misses, const Passes& passes) {
  return std::all_of(a.begin(), a.end(), [&](const PointOf<Number>& p) {
    return std::all_of(b.begin(), b.end(), [&](const PointOf<Number>& q) {
      return !misses(p, q) && ((is_open && passes(p, q)) || passes(inner(p, a), inner(q, b)));
    });
  });
}

/// Whether segment and box meet; if `is_open`, their relative interiors.
template <class Coordinate, class Number>
[[nodiscard]] bool passes_box(const PointOf<Coordinate>& p, const PointOf<Coordinate>& q, const BoxOf<Number>& box,
                              bool is_open) {
  Times<Coordinate> times(is_open);
  for (std::size_t k = 0; k != 3; ++k) {
    const Coordinate way = q[k] - p[k];
    if (box.is_flat(k)) {
      times.require_zero(p[k] - box.lo[k], way);
    } else {
      times.require(p[k] - box.lo[k], way);
      times.require(box.hi[k] - p[k], -way);
    }
  }
  return times.are_there();
}

/// Whether all segments go from one side of a polygon to the other strictly within its edges.
template <class Number>
[[nodiscard]] bool polygon_blocks(const std::vector<PointOf<Number>>& a, const std::vector<PointOf<Number>>& b,
                                  const std::vector<PointOf<Number>>& polygon) {
  using Point = PointOf<Number>;
  // All corners are in one plane: three that are not in line span it.
  std::size_t third = 0;
  std::size_t second = 0;
  for (std::size_t i = 1; i != polygon.size() && third == 0; ++i) {
    for (std::size_t j = i + 1; j < polygon.size() && third == 0; ++j) {
      const Point u = minus(polygon[i], polygon[0]);
      const Point v = minus(polygon[j], polygon[0]);
      if (u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0]) continue;
      second = i;
      third = j;
    }
  }
  if (third == 0) return false;
  const auto side = [&](const auto& r) {
    using Coordinate = typename std::decay_t<decltype(r)>::value_type;
    const auto corner = [&](std::size_t i) { return as<Coordinate>(polygon[i]); };
    return sign<Coordinate>(
        determinant(minus(corner(second), corner(0)), minus(corner(third), corner(0)), minus(r, corner(0))));
  };
  const auto misses = [&](const Point& p, const Point& q) { return side(p) * side(q) == 1; };
  return all_segments(a, b, true, misses, [&](const auto& p, const auto& q) {
    using Coordinate = typename std::decay_t<decltype(p)>::value_type;
    const auto corner = [&](std::size_t i) { return as<Coordinate>(polygon[i % polygon.size()]); };
    if (side(p) * side(q) != -1) return false;
    // The line passes all edges on the same side.
    int all = 0;
    for (std::size_t i = 0; i != polygon.size(); ++i) {
      const PointOf<Coordinate> from = corner(i);
      const PointOf<Coordinate> to = corner(i + 1);
      if (from == to) continue;
      const int one = sign<Coordinate>(determinant(minus(from, p), minus(to, p), minus(q, p)));
      if (one == 0 || (all != 0 && one != all)) return false;
      all = one;
    }
    return true;
  });
}

}  // namespace shaftcull::oracle
