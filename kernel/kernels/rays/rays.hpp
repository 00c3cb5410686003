// SPDX-License-Identifier: MIT
/// Rays between two patches in lanes, as RayKernels has it. No operation is used that some instruction sets round
/// twice: the rays that are met are the same everywhere.
#pragma once

#include "kernels/rays/ray_packet.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Three coordinates of a ray, a ray a lane.
template <class L>
struct RayVectors {
  typename L::Vector of[3];

  static RayVectors load(const float (&from)[3][most_packet_rays], unsigned lane) noexcept {
    return {{L::load(from[0] + lane), L::load(from[1] + lane), L::load(from[2] + lane)}};
  }
  void store(float (&to)[3][most_packet_rays], unsigned lane) const noexcept {
    for (unsigned k = 0; k < 3; ++k) L::store(to[k] + lane, of[k]);
  }
};

template <class L>
typename L::Vector dot(const RayVectors<L>& a, const float (&b)[3]) noexcept {
  const auto xy = L::add(L::multiply(a.of[0], L::all(b[0])), L::multiply(a.of[1], L::all(b[1])));
  return L::add(xy, L::multiply(a.of[2], L::all(b[2])));
}

/// The point (u, v) of a patch, relative to its first corner.
template <class L>
RayVectors<L> point_of(const RayPatch& patch, typename L::Vector u, typename L::Vector v) noexcept {
  using Vector = typename L::Vector;
  Vector edge[2][3];
  for (unsigned e = 0; e < 2; ++e) {
    for (unsigned k = 0; k < 3; ++k) edge[e][k] = L::all(patch.edge[e][k]);
  }
  if (patch.triangles != 0) {
    const Vector share = u;
    u = L::multiply(share, L::all(patch.inverse[0]));
    for (unsigned i = 1; i < patch.triangles; ++i) {
      const Vector first = L::all(patch.first[i]);
      const auto is_behind = L::less_equal(first, share);
      u = L::choose(is_behind, L::multiply(L::subtract(share, first), L::all(patch.inverse[i])), u);
      for (unsigned e = 0; e < 2; ++e) {
        for (unsigned k = 0; k < 3; ++k) edge[e][k] = L::choose(is_behind, L::all(patch.edge[i + e][k]), edge[e][k]);
      }
    }
    // The square is folded along its diagonal, which keeps neighbours together.
    const Vector one = L::all(1.0F);
    const auto is_outside = L::less(one, L::add(u, v));
    u = L::choose(is_outside, L::subtract(one, u), u);
    v = L::choose(is_outside, L::subtract(one, v), v);
  }
  RayVectors<L> point;
  for (unsigned k = 0; k < 3; ++k) point.of[k] = L::add(L::multiply(u, edge[0][k]), L::multiply(v, edge[1][k]));
  return point;
}

/// As RayKernels has it.
template <class L>
std::uint64_t form_rays(const RayPatch& a, const RayPatch& b, const float* const* points, const float* shift,
                        unsigned count, RayPacket& packet) noexcept {
  using Vector = typename L::Vector;
  packet.count = count;
  float between[3];
  for (unsigned k = 0; k < 3; ++k) {
    packet.origin[k] = a.corner[k];
    between[k] = b.corner[k] - a.corner[k];
  }
  const Vector one = L::all(1.0F);
  const Vector none = L::all(0.0F);
  std::uint64_t facing = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    Vector at[4];
    for (unsigned s = 0; s < 4; ++s) {
      const Vector moved = L::add(L::load(points[s] + lane), L::all(shift[s]));
      at[s] = L::choose(L::less_equal(one, moved), L::subtract(moved, one), moved);
    }
    const RayVectors<L> from = point_of<L>(a, at[0], at[1]);
    RayVectors<L> way = point_of<L>(b, at[2], at[3]);
    RayVectors<L> inverse;
    Vector square = none;
    for (unsigned k = 0; k < 3; ++k) {
      way.of[k] = L::subtract(L::add(way.of[k], L::all(between[k])), from.of[k]);
      inverse.of[k] = L::divide(one, way.of[k]);
      square = L::add(square, L::multiply(way.of[k], way.of[k]));
    }
    const Vector leaving = dot<L>(way, a.normal);
    const Vector arriving = L::subtract(none, dot<L>(way, b.normal));
    const auto in_front = L::both(L::less(L::all(a.least_rise), leaving), L::less(L::all(b.least_rise), arriving));
    facing |= L::bits(in_front) << lane;
    const Vector weight = L::multiply(L::divide(leaving, square), L::divide(arriving, square));
    from.store(packet.from, lane);
    way.store(packet.way, lane);
    inverse.store(packet.inverse, lane);
    L::store(packet.weight + lane, L::choose(in_front, L::magnitude(weight), none));
  }
  return facing;
}

/// As RayKernels has it. Where a ray enters the last of the three slabs of a box, and where it leaves the first: T. Kay
/// and J. Kajiya, "Ray Tracing Complex Scenes", 1986. A ray in the plane of a face may count as one that is inside.
template <class L>
std::uint64_t meet_box(const RayPacket& packet, const float* box, std::uint64_t asked) noexcept {
  using Vector = typename L::Vector;
  std::uint64_t met = 0;
  for (unsigned lane = 0; lane < packet.count; lane += L::width) {
    if ((asked & lanes_of<L>(lane)) == 0) continue;
    Vector first = L::all(0.0F);
    Vector last = L::all(1.0F);
    for (unsigned k = 0; k < 3; ++k) {
      const Vector from = L::load(packet.from[k] + lane);
      const Vector inverse = L::load(packet.inverse[k] + lane);
      const Vector low = L::multiply(L::subtract(L::all(box[k] - packet.origin[k]), from), inverse);
      const Vector high = L::multiply(L::subtract(L::all(box[k + 3] - packet.origin[k]), from), inverse);
      first = L::maximum(L::minimum(low, high), first);
      last = L::minimum(L::maximum(low, high), last);
    }
    met |= L::bits(L::less(first, last)) << lane;
  }
  return met;
}

/// A point of a scene, relative to the origin of a packet.
template <class L>
struct RelativePoint {
  float of[3];

  RelativePoint(const RayPacket& packet, const float (&point)[3]) noexcept {
    for (unsigned k = 0; k < 3; ++k) of[k] = point[k] - packet.origin[k];
  }
  [[nodiscard]] RayVectors<L> to(const RayVectors<L>& point) const noexcept {
    return {{L::subtract(point.of[0], L::all(of[0])), L::subtract(point.of[1], L::all(of[1])),
             L::subtract(point.of[2], L::all(of[2]))}};
  }
};

/// As RayKernels has it: the part of the ray behind each plane, one after the other.
template <class L>
std::uint64_t meet_body(const RayPacket& packet, const RayPlane* planes, std::size_t count, float margin,
                        std::uint64_t asked) noexcept {
  using Vector = typename L::Vector;
  const Vector none = L::all(0.0F);
  std::uint64_t met = 0;
  for (unsigned lane = 0; lane < packet.count; lane += L::width) {
    std::uint64_t left = asked & lanes_of<L>(lane);
    if (left == 0) continue;
    const auto from = RayVectors<L>::load(packet.from, lane);
    const auto way = RayVectors<L>::load(packet.way, lane);
    Vector first = none;
    Vector last = L::all(1.0F);
    for (std::size_t i = 0; i < count && left != 0; ++i) {
      const RelativePoint<L> point(packet, planes[i].point);
      const Vector height = L::add(dot<L>(point.to(from), planes[i].normal), L::all(margin));
      const Vector rise = dot<L>(way, planes[i].normal);
      const Vector crossing = L::divide(L::subtract(none, height), rise);
      const auto falls = L::less(rise, none);
      const auto rises = L::less(none, rise);
      first = L::choose(falls, L::maximum(crossing, first), first);
      last = L::choose(rises, L::minimum(crossing, last), last);
      // Along the plane, a ray is behind it all the way or not at all.
      last = L::choose(L::either(falls, L::either(rises, L::less(height, none))), last, none);
      left &= L::bits(L::less(first, last)) << lane;
    }
    met |= left;
  }
  return met;
}

/// A vector of a RayTriangle.
enum class OfTriangle : unsigned char { normal, across_u, across_v };

/// A ray and a triangle a lane: bits of those of `asked` where the ray passes through the triangle, with both ends more
/// than `margin` from its plane. `at` is where the ray starts, relative to the triangle's point; along(a, what) is the
/// product of `a` with a vector of the triangle.
template <class L, class Along>
SHAFTCULL_ALWAYS_INLINE inline std::uint64_t passing_through(const RayVectors<L>& at, const RayVectors<L>& way,
                                                             float margin, std::uint64_t asked, Along along) noexcept {
  using Vector = typename L::Vector;
  const Vector start = along(at, OfTriangle::normal);
  const Vector end = L::add(start, along(way, OfTriangle::normal));
  const auto passes =
      L::both(L::less(L::minimum(start, end), L::all(-margin)), L::less(L::all(margin), L::maximum(start, end)));
  if ((L::bits(passes) & asked) == 0) return 0;
  const Vector t = L::divide(start, L::subtract(start, end));
  RayVectors<L> hit;
  for (unsigned k = 0; k < 3; ++k) hit.of[k] = L::add(at.of[k], L::multiply(t, way.of[k]));
  const Vector u = along(hit, OfTriangle::across_u);
  const Vector v = along(hit, OfTriangle::across_v);
  const Vector none = L::all(0.0F);
  const auto is_inside =
      L::both(L::both(L::less_equal(none, u), L::less_equal(none, v)), L::less_equal(L::add(u, v), L::all(1.0F)));
  return L::bits(L::both(passes, is_inside)) & asked;
}

/// As meet_triangles() of RayKernels, of the triangles at(0) to at(count − 1).
template <class L, class At>
std::uint64_t meet_each(const RayPacket& packet, At at, std::size_t count, float margin, std::uint64_t asked) noexcept {
  std::uint64_t met = 0;
  for (unsigned lane = 0; lane < packet.count; lane += L::width) {
    const std::uint64_t lanes = (asked & lanes_of<L>(lane)) >> lane;
    if (lanes == 0) continue;
    const auto from = RayVectors<L>::load(packet.from, lane);
    const auto way = RayVectors<L>::load(packet.way, lane);
    std::uint64_t left = lanes;
    for (std::size_t i = 0; i < count && left != 0; ++i) {
      const RayTriangle triangle = at(i);
      const RayVectors<L> start = RelativePoint<L>(packet, triangle.point).to(from);
      left &= ~passing_through<L>(start, way, margin, left, [&triangle](const RayVectors<L>& a, OfTriangle what) {
        return what == OfTriangle::normal     ? dot<L>(a, triangle.normal)
               : what == OfTriangle::across_u ? dot<L>(a, triangle.across_u)
                                              : dot<L>(a, triangle.across_v);
      });
    }
    met |= (lanes & ~left) << lane;
  }
  return met;
}

/// As RayKernels has it.
template <class L>
std::uint64_t meet_triangles(const RayPacket& packet, const RayTriangle* triangles, std::size_t count, float margin,
                             std::uint64_t asked) noexcept {
  return meet_each<L>(
      packet, [triangles](std::size_t i) { return triangles[i]; }, count, margin, asked);
}

}  // namespace shaftcull::kernel
