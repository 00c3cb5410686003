// SPDX-License-Identifier: MIT
#include "exact/blocking.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "exact/edge.hpp"

namespace shaftcull::kernel {
namespace {

/// Whether x is strictly outside of the lo face f of an end, or of the hi face: all of the end is beyond x.
bool is_beyond(const OpenBox& end, unsigned f, float x) noexcept {
  return f < 3 ? x <= end.face[f] && x < end.inward[f] : x >= end.face[f] && x > end.inward[f];
}

/// Whether both ends and the box lie in one plane across axis `k`: a plane that puts no constraint on t.
bool share_a_plane(const OpenBox& a, const OpenBox& b, const float (&bound)[6], unsigned k) noexcept {
  const float x = bound[k];
  return bound[k + 3] == x && a.face[k] == x && a.face[k + 3] == x && b.face[k] == x && b.face[k + 3] == x;
}

/// Whether every segment is strictly between the box's two faces on axis `k` somewhere on its way. false for NaN.
bool reaches_across(const OpenBox& a, const OpenBox& b, const float (&bound)[6], unsigned k) noexcept {
  return bound[k] <= bound[k + 3] && (is_beyond(a, k, bound[k]) || is_beyond(b, k, bound[k])) &&
         (is_beyond(a, k + 3, bound[k + 3]) || is_beyond(b, k + 3, bound[k + 3]));
}

/// Whether no segment is at the coordinate x on the axis of face f as late as the moving face is, where that bounds t
/// from below, or as early, where it bounds t from above. The moving face is at x between the ends or at one of them.
bool is_not_attained(const OpenBox& a, const OpenBox& b, unsigned f, float x) noexcept {
  return (a.inward[f] != a.face[f] && x != b.face[f]) || (b.inward[f] != b.face[f] && x != a.face[f]);
}

}  // namespace

bool box_blocks(const OpenBox& a, const OpenBox& b, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (!reaches_across(a, b, bound, k) && !share_a_plane(a, b, bound, k)) return false;
  }
  const auto is_flat = [&](unsigned face) { return bound[face % 3] == bound[face % 3 + 3]; };
  const auto is_strict = [&](unsigned face) { return is_not_attained(a, b, face, bound[face]); };
  // lo(t) > bound.lo and hi(t) < bound.hi: red faces bound t from below, blue ones from above.
  const MovingFaces moving(a.face, b.face);
  const Faces faces(moving);
  for (unsigned r = 0; r < faces.reds; ++r) {
    const unsigned red = faces.red[r];
    if (!std::isfinite(bound[red])) continue;
    for (unsigned n = 0; n < faces.blues; ++n) {
      const unsigned blue = faces.blue[n];
      if (blue % 3 == red % 3 || !std::isfinite(bound[blue])) continue;
      const int later = Edge(moving, red, blue).side(bound[red], bound[blue]);
      if (later > 0) continue;
      if (later < 0) return false;
      if (!is_strict(red) && !is_strict(blue) && !(is_flat(red) && is_flat(blue))) return false;
    }
  }
  return true;
}

bool box_blocks(const ShaftData& shaft, const float (&bound)[6]) noexcept {
  if (shaft.is_hull()) return box_blocks(first_end(*shaft.hull), second_end(*shaft.hull), bound);
  OpenBox a;
  OpenBox b;
  for (unsigned f = 0; f != 6; ++f) {
    a.face[f] = shaft.a[f];
    b.face[f] = shaft.b[f];
    a.inward[f] = shaft.a[(f + 3) % 6];
    b.inward[f] = shaft.b[(f + 3) % 6];
  }
  return box_blocks(a, b, bound);
}

namespace {

/// Points of an end, and a half-space on one axis: how many of the points are in it, and beyond its face.
struct PointsOfFace {
  bool some_within = false;  ///< strictly
  bool some_beyond = false;  ///< strictly

  /// The half-space of a lo face f has larger coordinates than x, that of a hi face smaller ones.
  PointsOfFace(std::span<const Vec3> points, unsigned f, float x) noexcept {
    for (const Vec3& point : points) {
      const float at = point[f % 3];
      some_within |= f < 3 ? at > x : at < x;
      some_beyond |= f < 3 ? at < x : at > x;
    }
  }
  /// Whether the relative interior of the points' hull is strictly within.
  [[nodiscard]] bool are_within() const noexcept { return some_within && !some_beyond; }
};

/// Whether a point is not strictly within the half-space of face f.
bool is_not_within(const Vec3& point, unsigned f, float x) noexcept {
  return f < 3 ? point[f] <= x : point[f - 3] >= x;
}

/// Whether a segment certainly misses a box. Then so do those near it.
bool certainly_misses(const Vec3& from, const Vec3& to, const float (&bound)[6]) noexcept {
  constexpr double margin = 0x1p-40;  // a few roundings of doubles
  double enters = 0;
  double leaves = 1;
  for (unsigned k = 0; k != 3; ++k) {
    const double along = double{to[k]} - from[k];
    const double lo = double{bound[k]} - from[k];
    const double hi = double{bound[k + 3]} - from[k];
    if (along == 0) {
      if (lo > 0 || hi < 0) return true;
      continue;
    }
    enters = std::max(enters, (along > 0 ? lo : hi) / along);
    leaves = std::min(leaves, (along > 0 ? hi : lo) / along);
  }
  return enters * (1 - margin) - margin > leaves + margin * std::fabs(leaves);
}

/// Whether every segment leaves the half-space of face `last`, in which it starts, after it enters that of face
/// `first`, in which it ends; or at the same time, if `together`.
bool leave_after_entering(std::span<const Vec3> a, std::span<const Vec3> b, const float (&bound)[6], unsigned last,
                          unsigned first, bool together) noexcept {
  const float x = bound[last];
  const float y = bound[first];
  const unsigned i = last % 3;
  const unsigned j = first % 3;
  const bool is_mirrored = (last < 3) != (first < 3);
  bool is_strict = together || PointsOfFace(a, first, y).some_within || PointsOfFace(b, last, x).some_within;
  for (const Vec3& p : a) {
    if (!is_not_within(p, first, y)) continue;
    for (const Vec3& q : b) {
      if (!is_not_within(q, last, x)) continue;
      // With depths s in the half-space of `last` and e in that of `first`: s(p) e(q) − s(q) e(p).
      const int later = determinant_sign({p[i], x}, {q[i], x}, {p[j], y}, {q[j], y});
      if (later == (is_mirrored ? 1 : -1)) return false;
      is_strict |= later != 0;
    }
  }
  return is_strict;
}

}  // namespace

bool box_blocks(std::span<const Vec3> a, std::span<const Vec3> b, const float (&bound)[6]) noexcept {
  if (certainly_misses(a.front(), b.front(), bound) || certainly_misses(a.back(), b.back(), bound)) return false;
  bool leaves[6];  // segments start within the half-space of the face, and some end beyond it or at it
  bool enters[6];
  for (unsigned f = 0; f != 6; ++f) {
    const unsigned k = f % 3;
    if (!(bound[k] <= bound[k + 3])) return false;
    const PointsOfFace of_a(a, f, bound[f]);
    const PointsOfFace of_b(b, f, bound[f]);
    leaves[f] = of_a.are_within() && !of_b.are_within();
    enters[f] = of_b.are_within() && !of_a.are_within();
    const bool is_passed = of_a.are_within() || of_b.are_within();
    const bool share_a_plane =
        bound[k] == bound[k + 3] && !of_a.some_within && !of_a.some_beyond && !of_b.some_within && !of_b.some_beyond;
    if (!is_passed && !share_a_plane) return false;
  }
  for (unsigned last = 0; last != 6; ++last) {
    for (unsigned first = 0; first != 6; ++first) {
      if (!leaves[last] || !enters[first] || last % 3 == first % 3) continue;
      const bool are_flat = bound[last % 3] == bound[last % 3 + 3] && bound[first % 3] == bound[first % 3 + 3];
      if (!leave_after_entering(a, b, bound, last, first, are_flat)) return false;
    }
  }
  return true;
}

}  // namespace shaftcull::kernel
