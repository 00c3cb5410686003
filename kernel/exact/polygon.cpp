// SPDX-License-Identifier: MIT
#include "exact/polygon.hpp"

#include <cmath>
#include <cstddef>

#include "exact/blocking.hpp"
#include "exact/orientation.hpp"
#include "exact/sides.hpp"
#include "support/double3.hpp"

namespace shaftcull::kernel {
namespace {

/// The sign of (b − a) · ((p − a) × (q − a)), or 0 if it is not certain.
int certain_orientation(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) noexcept {
  const Double3 u = between(a, p);
  const Double3 v = between(a, q);
  const Double3 w = between(a, b);
  double magnitude = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    magnitude += std::fabs(w[k]) * (std::fabs(u[i] * v[j]) + std::fabs(u[j] * v[i]));
  }
  // Each of three factors is a rounded difference; two products, a difference and two sums round as well: fewer than 8
  // roundings a term. Products of three differences of floats neither over- nor underflow.
  constexpr double margin = 16 * 0x1p-53;
  const double value = dot(cross(u, v), w);
  if (std::fabs(value) > margin * magnitude) return value > 0 ? 1 : -1;
  return 0;
}

/// The sign, exactly: on which side of the line from a to b the edge from p to q passes, or on which side of the plane
/// of b, p and q the point a is.
int orientation(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) noexcept {
  const int certain = certain_orientation(a, b, p, q);
  if (certain != 0) return certain;
  return exact_sign(Steps(a, p).of, Steps(a, q).of, Steps(a, b).of);
}

/// Whether a segment certainly passes two edges of a polygon on different sides. Then so do segments near it: the ends
/// see each other past the polygon. Most polygons are far off, and this is quick.
bool certainly_misses(const Vec3& from, const Vec3& to, std::span<const Vec3> polygon) noexcept {
  int turn = 0;
  for (std::size_t i = 0; i != polygon.size(); ++i) {
    const int side = certain_orientation(from, to, polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]);
    if (side == 0) continue;
    if (side == -turn) return true;
    turn = side;
  }
  return false;
}

/// Which points of two hulls count.
enum class Ends : unsigned char { relative_interiors, closed };

/// The sign that a function has at all points of a hull that count, or 0 if there is none, or if it is 0 somewhere. The
/// signs are those at the corners.
///
/// An affine function that is nowhere negative on a hull is positive in its relative interior, unless it is 0 on all of
/// it. The same is true of a function that is affine in a point of either of two hulls.
template <Ends ends>
int common_sign(const Sides& sides) noexcept {
  if (sides.are_mixed() || (ends == Ends::closed && sides.in_plane)) return 0;
  return sides.in_front ? 1 : sides.behind ? -1 : 0;
}

/// The side of the line through any two points of the ends on which the edge from p to q passes, or 0.
template <Ends ends>
int side_of_edge(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& p, const Vec3& q) noexcept {
  Sides sides;
  for (const Vec3& from : a) {
    for (const Vec3& to : b) {
      sides.add(orientation(from, to, p, q));
      if (sides.are_mixed()) return 0;
    }
  }
  return common_sign<ends>(sides);
}

/// The side of the plane of three points on which an end is, or 0.
template <Ends ends>
int side_of_plane(std::span<const Vec3> end, const Vec3& p, const Vec3& q, const Vec3& r) noexcept {
  Sides sides;
  for (const Vec3& point : end) sides.add(orientation(p, point, q, r));
  return common_sign<ends>(sides);
}

/// Whether the ends are strictly on different sides of the plane of three points; also if these are on one line.
template <Ends ends>
bool passes_plane(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& p, const Vec3& q,
                  const Vec3& r) noexcept {
  const auto cross = [&](std::size_t i, std::size_t j) {
    return determinant_sign({q[i], p[i]}, {q[j], p[j]}, {r[i], p[i]}, {r[j], p[j]});
  };
  if (cross(0, 1) == 0 && cross(1, 2) == 0 && cross(2, 0) == 0) return true;
  const int of_a = side_of_plane<ends>(a, p, q, r);
  return of_a != 0 && side_of_plane<ends>(b, p, q, r) == -of_a;
}

template <Ends ends>
bool blocks(std::span<const Vec3> a, std::span<const Vec3> b, std::span<const Vec3> polygon) noexcept {
  if (certainly_misses(a.front(), b.front(), polygon) || certainly_misses(a.back(), b.back(), polygon)) return false;
  const std::size_t points = polygon.size();
  int turn = 0;
  for (std::size_t i = 0; i != points; ++i) {
    const Vec3& p = polygon[i];
    const Vec3& q = polygon[i + 1 == points ? 0 : i + 1];
    if (p == q) continue;
    const int side = side_of_edge<ends>(a, b, p, q);
    if (side == 0 || side == -turn) return false;
    turn = side;
  }
  if (turn == 0) return false;
  for (std::size_t i = 2; i != points; ++i) {
    if (!passes_plane<ends>(a, b, polygon[0], polygon[i - 1], polygon[i])) return false;
  }
  return true;
}

}  // namespace

BoxCorners::BoxCorners(const float (&face)[6]) noexcept {
  for (unsigned c = 0; c != 8; ++c) {
    Vec3 point{};
    bool is_another = false;  // corner with a smaller number
    for (unsigned k = 0; k != 3; ++k) {
      const bool is_hi = (c >> k & 1U) != 0;
      point[k] = face[is_hi ? k + 3 : k];
      is_another |= is_hi && face[k] == face[k + 3];
    }
    if (!is_another) corner_[count_++] = point;
  }
}

bool polygon_blocks(std::span<const Vec3> a, std::span<const Vec3> b, std::span<const Vec3> polygon) noexcept {
  return blocks<Ends::relative_interiors>(a, b, polygon);
}

bool polygon_blocks_closed(std::span<const Vec3> a, std::span<const Vec3> b, std::span<const Vec3> polygon) noexcept {
  return blocks<Ends::closed>(a, b, polygon);
}

bool polygon_blocks(const ShaftData& shaft, std::span<const Vec3> polygon) noexcept {
  if (shaft.is_hull()) return polygon_blocks(first_end(*shaft.hull), second_end(*shaft.hull), polygon);
  return polygon_blocks(BoxCorners(shaft.a).get(), BoxCorners(shaft.b).get(), polygon);
}

}  // namespace shaftcull::kernel
