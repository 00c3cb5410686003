// SPDX-License-Identifier: MIT
#include "exact/polygon.hpp"

#include <cstddef>

#include "exact/blocking.hpp"
#include "exact/orientation.hpp"
#include "exact/sides.hpp"

namespace shaftcull::kernel {
namespace {

/// Whether a segment certainly passes two edges of a polygon on different sides. Then so do segments near it: the ends
/// see each other past the polygon. Most polygons are far off, and this is quick.
bool certainly_misses(const Vec3& from, const Vec3& to, std::span<const Vec3> polygon) noexcept {
  int turn = 0;
  for (std::size_t i = 0; i != polygon.size(); ++i) {
    const Vec3& next = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const int side = plane_of(from, polygon[i], next).certain_side({to[0], to[1], to[2]});
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
    const SpannedPlane plane = plane_of(from, p, q);
    for (const Vec3& to : b) {
      sides.add(side_of(plane, to));
      if (sides.are_mixed()) return 0;
    }
  }
  return common_sign<ends>(sides);
}

/// The side of the plane of three points on which an end is, or 0.
template <Ends ends>
int side_of_plane(std::span<const Vec3> end, const Vec3& p, const Vec3& q, const Vec3& r) noexcept {
  const SpannedPlane plane = plane_of(p, q, r);
  Sides sides;
  for (const Vec3& point : end) sides.add(side_of(plane, point));
  return common_sign<ends>(sides);
}

/// Whether the ends are strictly on different sides of the plane of three points; also if these are on one line.
template <Ends ends>
bool passes_plane(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& p, const Vec3& q,
                  const Vec3& r) noexcept {
  if (are_on_one_line(p, q, r)) return true;
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
