// SPDX-License-Identifier: MIT
/// Triangles against a convex hull: what floats are certain of. The rest is left to the exact predicate.
///
/// A triangle *misses* the hull for certain if a plane has both strictly on different sides: a plane of the hull, that
/// of the triangle, or one along an edge of each (Gottschalk, Lin and Manocha, *OBBTree*, 1996). It *meets* the hull
/// for certain if one of its points is strictly behind all planes of the hull: a vertex, a point of an edge, or the
/// middle of the section of the hull with the triangle's plane. Neither depends on the contact. docs/exactness.md has
/// the margins.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstdint>

#include "compiled/hull_data.hpp"
#include "exact/hull_triangle.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Times the magnitudes of all terms of a depth: what the depth of a vertex, or of a point between them, is off by.
inline constexpr float triangle_depth_margin = 16 * 0x1p-24F;
/// Times the magnitudes of edges and of distances from vertices of the hull: what a height of three factors is off by.
inline constexpr float triangle_height_margin = 24 * 0x1p-24F;
/// Times the magnitude of an edge: what its product with a normal of the hull is off by.
inline constexpr float triangle_slope_margin = 16 * 0x1p-24F;
/// How much later an edge must leave the hull than it enters it, in shares of the edge.
inline constexpr float triangle_share_margin = 32 * 0x1p-24F;
/// Added to margins of heights, for products that are denormal.
inline constexpr float triangle_height_denormals = 0x1p-100F;
/// Triangles and hulls whose coordinates are larger do not suit floats: no product of three overflows.
inline constexpr float most_triangle_coordinate = 0x1p40F;

/// Which triangles of a vector meet the hull for certain, and which miss it.
struct TriangleLanes {
  std::uint64_t met = 0;
  std::uint64_t missed = 0;
};

/// A hull as vectors of triangles are compared with it.
template <class L>
class HullAndTriangles {
  using Vector = typename L::Vector;
  using Mask = typename L::Mask;

 public:
  explicit HullAndTriangles(const HullData& hull) noexcept
      : hull_(hull),
        below_(hull.is_bounded ? 1.0F : 0.0F),
        most_(hull.farthest < most_triangle_coordinate ? hull.farthest : most_triangle_coordinate) {
    bool suits = hull.suits_floats;
    for (unsigned k = 0; k < 3; ++k) {
      float lo = FLT_MAX;
      float hi = -FLT_MAX;
      for (unsigned v = 0; v < hull.points; ++v) {
        lo = hull.vertex[v][k] < lo ? hull.vertex[v][k] : lo;
        hi = hull.vertex[v][k] > hi ? hull.vertex[v][k] : hi;
      }
      point_lo_[k] = lo;
      point_hi_[k] = hi;
      suits = suits && lo > -most_triangle_coordinate && hi < most_triangle_coordinate;
      for (unsigned v = hull.points; v < hull.vertices; ++v) {
        suits = suits && fabsf(hull.vertex[v][k]) < most_triangle_coordinate;
      }
    }
    if (!suits) most_ = -1;
  }

  /// The triangles at `at` in nine streams whose bits are in `asked`.
  [[nodiscard]] TriangleLanes lanes(const float* const* stream, std::size_t at, std::uint64_t asked) const noexcept {
    const Corners t(stream, at);
    Mask is_near = L::less_equal(t.most[0], L::all(most_));  // not if a coordinate is not finite
    for (unsigned k = 1; k < 3; ++k) is_near = L::both(is_near, L::less_equal(t.most[k], L::all(most_)));
    const std::uint64_t certain = asked & L::bits(is_near);
    TriangleLanes found;
    const auto left = [&] { return certain & ~(found.met | found.missed); };
    if (left() == 0) return found;
    by_vertices(t, found);
    if (left() == 0 || hull_.facets == 0) return only(found, certain);
    found.met |= by_edges_of_triangles(t);
    if (left() == 0) return only(found, certain);
    const Edges edges(*this, t);
    by_section(t, edges, found);
    if (left() == 0) return only(found, certain);
    found.missed |= by_pairs_of_edges(t, edges) & ~found.met;
    return only(found, certain);
  }

 private:
  static TriangleLanes only(const TriangleLanes& found, std::uint64_t lanes) noexcept {
    return {found.met & lanes, found.missed & lanes & ~found.met};
  }

  /// The vertices of some triangles.
  struct Corners {
    Vector x[3][3];  ///< of vertex v, coordinate k
    Vector most[3];  ///< no coordinate k has a larger magnitude; not a number if one of them is none

    Corners(const float* const* stream, std::size_t at) noexcept {
      for (unsigned v = 0; v < 3; ++v) {
        for (unsigned k = 0; k < 3; ++k) x[v][k] = L::load(stream[3 * v + k] + at);
      }
      for (unsigned k = 0; k < 3; ++k) {
        most[k] = L::add(L::magnitude(x[0][k]), L::add(L::magnitude(x[1][k]), L::magnitude(x[2][k])));
      }
    }
  };

  /// A plane of the hull, by the coordinates that it has.
  template <unsigned coordinates>
  struct Depth {
    Vector inward[coordinates];
    Vector offset;
    unsigned axis[coordinates];
    Vector slack;

    Depth(const HullAndTriangles& hull, const HullData::Plane& plane, const Corners& t) noexcept
        : offset(L::all(plane.offset - hull.below_)) {
      Vector terms = L::all(plane.magnitude + 1);
      for (unsigned i = 0; i < coordinates; ++i) {
        inward[i] = L::all(plane.inward[i]);
        axis[i] = plane.near[i] % 3;
        terms = L::multiply_add(t.most[axis[i]], L::magnitude(inward[i]), terms);
      }
      slack = L::multiply(terms, L::all(triangle_depth_margin));
    }
    [[nodiscard]] Vector of(const Vector (&x)[3]) const noexcept {
      Vector sum = offset;
      for (unsigned i = 0; i < coordinates; ++i) sum = L::multiply_add(x[axis[i]], inward[i], sum);
      return sum;
    }
  };

  /// Calls visit(depth) for the planes of the hull.
  template <class Visit>
  SHAFTCULL_ALWAYS_INLINE void for_each_plane(const Corners& t, const Visit& visit) const noexcept {
    for (unsigned p = 0; p < hull_.faces; ++p) visit(Depth<3>(*this, hull_.plane[p], t));
    for (unsigned p = hull_.faces; p < unsigned{hull_.faces} + hull_.edges; ++p)
      visit(Depth<2>(*this, hull_.plane[p], t));
  }

  /// Vertices strictly behind all planes of the hull and within its box, and triangles beyond a plane.
  void by_vertices(const Corners& t, TriangleLanes& found) const noexcept {
    Vector least[3];
    for (unsigned v = 0; v < 3; ++v) least[v] = depth_in_box(t.x[v]);
    Vector nearest = L::all(INFINITY);  // of the depths of each plane's nearest vertex, the smallest
    for_each_plane(t, [&](const auto& depth) {
      const Vector d[3] = {depth.of(t.x[0]), depth.of(t.x[1]), depth.of(t.x[2])};
      for (unsigned v = 0; v < 3; ++v) least[v] = L::minimum(L::subtract(d[v], depth.slack), least[v]);
      nearest = L::minimum(L::add(L::maximum(d[0], L::maximum(d[1], d[2])), depth.slack), nearest);
    });
    const Vector zero = L::all(0.0F);
    found.missed |= L::bits(L::less(nearest, zero));
    if (hull_.facets == 0) return;
    for (const Vector& depth_of_vertex : least) found.met |= L::bits(L::less(zero, depth_of_vertex));
  }

  /// Positive iff a point is strictly within the hull's box. The sign is exact.
  [[nodiscard]] Vector depth_in_box(const Vector (&x)[3]) const noexcept {
    Vector least = L::all(INFINITY);
    for (unsigned k = 0; k < 3; ++k) {
      least = L::minimum(L::subtract(x[k], L::all(hull_.box[k])), least);
      least = L::minimum(L::subtract(L::all(hull_.box[k + 3]), x[k]), least);
    }
    return least;
  }

  /// Bits of triangles an edge of which is strictly behind all planes somewhere: the shares of the edge that are behind
  /// the planes have one in common.
  [[nodiscard]] std::uint64_t by_edges_of_triangles(const Corners& t) const noexcept {
    const Vector zero = L::all(0.0F);
    Vector from[3] = {zero, zero, zero};
    Vector to[3] = {L::all(1.0F), L::all(1.0F), L::all(1.0F)};
    // Depths at both ends of an edge, at least.
    const auto cut = [&](unsigned e, Vector a, Vector b) {
      const Vector change = L::subtract(b, a);
      const Vector share = L::divide(L::subtract(zero, a), change);
      from[e] = L::choose(L::less(zero, change), L::maximum(share, from[e]), from[e]);
      to[e] = L::choose(L::less(change, zero), L::minimum(share, to[e]), to[e]);
      // In front all along.
      const Mask never = L::both(L::less_equal(a, zero), L::less_equal(b, zero));
      to[e] = L::choose(never, L::all(-1.0F), to[e]);
    };
    for (unsigned k = 0; k < 3; ++k) {
      for (unsigned e = 0; e < 3; ++e) {
        const unsigned next = (e + 1) % 3;
        const Vector lo = L::all(hull_.box[k]);
        const Vector hi = L::all(hull_.box[k + 3]);
        if (hull_.box[k] > -FLT_MAX) cut(e, L::subtract(t.x[e][k], lo), L::subtract(t.x[next][k], lo));
        if (hull_.box[k + 3] < FLT_MAX) cut(e, L::subtract(hi, t.x[e][k]), L::subtract(hi, t.x[next][k]));
      }
    }
    for_each_plane(t, [&](const auto& depth) {
      Vector d[3];
      for (unsigned v = 0; v < 3; ++v) d[v] = L::subtract(depth.of(t.x[v]), depth.slack);
      for (unsigned e = 0; e < 3; ++e) cut(e, d[e], d[(e + 1) % 3]);
    });
    std::uint64_t met = 0;
    for (unsigned e = 0; e < 3; ++e) {
      met |= L::bits(L::less(L::add(from[e], L::all(triangle_share_margin)), to[e]));
    }
    return met;
  }

  /// The edges of some triangles, and how far these are from points of the hull.
  struct Edges {
    Vector along[3][3];  ///< from vertex e to the next one
    Vector length[3];    ///< the sum of the magnitudes of that
    Vector distance;     ///< at least the sum of the magnitudes of a way from a point of the hull to a vertex

    Edges(const HullAndTriangles& hull, const Corners& t) noexcept {
      for (unsigned e = 0; e < 3; ++e) {
        for (unsigned k = 0; k < 3; ++k) along[e][k] = L::subtract(t.x[(e + 1) % 3][k], t.x[e][k]);
        length[e] = L::add(L::magnitude(along[e][0]), L::add(L::magnitude(along[e][1]), L::magnitude(along[e][2])));
      }
      distance = L::all(0.0F);
      for (unsigned k = 0; k < 3; ++k) {
        Vector farthest = L::all(0.0F);
        for (unsigned v = 0; v < 3; ++v) {
          const Vector above = L::magnitude(L::subtract(t.x[v][k], L::all(hull.point_lo_[k])));
          const Vector under = L::magnitude(L::subtract(L::all(hull.point_hi_[k]), t.x[v][k]));
          farthest = L::maximum(above, L::maximum(under, farthest));
        }
        distance = L::add(farthest, distance);
      }
    }
  };

  static void cross(const Vector (&a)[3], const Vector (&b)[3], Vector (&normal)[3]) noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned i = (k + 1) % 3;
      const unsigned j = (k + 2) % 3;
      normal[k] = L::subtract(L::multiply(a[i], b[j]), L::multiply(a[j], b[i]));
    }
  }
  static Vector dot(const Vector (&a)[3], const Vector (&b)[3]) noexcept {
    return L::multiply_add(a[0], b[0], L::multiply_add(a[1], b[1], L::multiply(a[2], b[2])));
  }
  static Vector margin(Vector length, Vector other_length, Vector distance) noexcept {
    return L::multiply_add(L::multiply(L::multiply(length, other_length), distance), L::all(triangle_height_margin),
                           L::all(triangle_height_denormals));
  }

  /// By the triangle's plane: the hull may be on one side of it. If not, the middle of the section may be in the
  /// triangle, and behind all planes.
  void by_section(const Corners& t, const Edges& edges, TriangleLanes& found) const noexcept {
    Vector normal[3];
    cross(edges.along[0], edges.along[1], normal);
    const Vector of_points = margin(edges.length[0], edges.length[1], edges.distance);
    Vector height[HullData::most_vertices];
    Vector highest = L::all(-INFINITY);  // at most
    Vector lowest = L::all(INFINITY);    // at least
    for (unsigned v = 0; v < hull_.vertices; ++v) {
      Vector way[3];
      Vector slack = of_points;
      if (v < hull_.points) {
        for (unsigned k = 0; k < 3; ++k) way[k] = L::subtract(L::all(hull_.vertex[v][k]), t.x[1][k]);
        height[v] = dot(normal, way);
        highest = L::maximum(L::add(height[v], slack), highest);
        lowest = L::minimum(L::subtract(height[v], slack), lowest);
        continue;
      }
      for (unsigned k = 0; k < 3; ++k) way[k] = L::all(hull_.vertex[v][k]);
      height[v] = dot(normal, way);
      const float length = fabsf(hull_.vertex[v][0]) + fabsf(hull_.vertex[v][1]) + fabsf(hull_.vertex[v][2]);
      slack = margin(edges.length[0], edges.length[1], L::all(length));
      // A direction leads infinitely far to one side, or may do so.
      const Vector zero = L::all(0.0F);
      highest = L::choose(L::less(zero, L::add(height[v], slack)), L::all(INFINITY), highest);
      lowest = L::choose(L::less(L::subtract(height[v], slack), zero), L::all(-INFINITY), lowest);
    }
    const Vector zero = L::all(0.0F);
    found.missed |= L::bits(L::either(L::less(highest, zero), L::less(zero, lowest))) & ~found.met;
    Vector sum[3] = {zero, zero, zero};
    Vector count = zero;
    for (unsigned c = 0; c < hull_.creases; ++c) {
      const HullData::Crease& crease = hull_.crease[c];
      const Vector from = height[crease.from];
      const Vector to = height[crease.to];
      const Vector both = L::multiply(from, to);
      const bool is_ray = crease.to >= hull_.points;
      const Vector share = L::divide(from, is_ray ? L::subtract(zero, to) : L::subtract(from, to));
      const Mask crosses = L::less(both, zero);
      for (unsigned k = 0; k < 3; ++k) {
        const float along =
            is_ray ? hull_.vertex[crease.to][k] : hull_.vertex[crease.to][k] - hull_.vertex[crease.from][k];
        const Vector at = L::multiply_add(share, L::all(along), L::all(hull_.vertex[crease.from][k]));
        sum[k] = L::add(sum[k], L::choose(crosses, at, zero));
      }
      count = L::add(count, L::choose(crosses, L::all(1.0F), zero));
    }
    // Where the middle is in the triangle, as seen from vertex 1: by multiples of the edges to vertices 0 and 2.
    Vector way[3];
    for (unsigned k = 0; k < 3; ++k) way[k] = L::subtract(L::divide(sum[k], count), t.x[1][k]);
    const auto& a = edges.along[0];  // towards vertex 1
    const auto& b = edges.along[1];
    const Vector aa = dot(a, a);
    const Vector ab = dot(a, b);
    const Vector bb = dot(b, b);
    const Vector wa = dot(way, a);
    const Vector wb = dot(way, b);
    const Vector whole = L::subtract(L::multiply(aa, bb), L::multiply(ab, ab));
    const Vector back = L::divide(L::subtract(L::multiply(ab, wb), L::multiply(bb, wa)), whole);  // of −a
    const Vector on = L::divide(L::subtract(L::multiply(aa, wb), L::multiply(ab, wa)), whole);    // of b
    Vector point[3];
    for (unsigned k = 0; k < 3; ++k) {
      point[k] = L::add(t.x[1][k], L::subtract(L::multiply(on, b[k]), L::multiply(back, a[k])));
    }
    Mask is_in = L::less(L::add(back, on), L::all(1 - 0x1p-20F));
    is_in = L::both(is_in, L::both(L::less_equal(zero, back), L::less_equal(zero, on)));
    found.met |= L::bits(L::both(is_in, L::less(zero, least_depth(t, point)))) & ~found.missed;
  }

  /// At least the smallest depth of the real point that a computed point of the triangles stands for.
  [[nodiscard]] Vector least_depth(const Corners& t, const Vector (&point)[3]) const noexcept {
    Vector least = L::all(INFINITY);
    for (unsigned k = 0; k < 3; ++k) {
      const Vector slack = L::multiply(t.most[k], L::all(triangle_depth_margin));
      least = L::minimum(L::subtract(L::subtract(point[k], L::all(hull_.box[k])), slack), least);
      least = L::minimum(L::subtract(L::subtract(L::all(hull_.box[k + 3]), point[k]), slack), least);
    }
    for_each_plane(t, [&](const auto& depth) { least = L::minimum(L::subtract(depth.of(point), depth.slack), least); });
    return least;
  }

  /// Bits of triangles that a plane along an edge of theirs and one of the hull parts from it. The hull has a plane
  /// there, along a vector, if one of the two faces at its edge faces along it and the other one against it.
  [[nodiscard]] std::uint64_t by_pairs_of_edges(const Corners& t, const Edges& edges) const noexcept {
    const Vector zero = L::all(0.0F);
    Mask missed = L::less(zero, zero);
    for (unsigned c = 0; c < hull_.creases; ++c) {
      const HullData::Crease& crease = hull_.crease[c];
      const bool is_ray = crease.to >= hull_.points;
      Vector edge[3];
      Vector left[3];
      Vector right[3];
      Vector way[3][3];  // from the edge of the hull to each vertex
      float length = 0;
      for (unsigned k = 0; k < 3; ++k) {
        const float along =
            is_ray ? hull_.vertex[crease.to][k] : hull_.vertex[crease.to][k] - hull_.vertex[crease.from][k];
        length += fabsf(along);
        edge[k] = L::all(along);
        left[k] = L::all(hull_.facet[crease.left][k]);
        right[k] = L::all(hull_.facet[crease.right][k]);
        for (unsigned v = 0; v < 3; ++v) way[v][k] = L::subtract(t.x[v][k], L::all(hull_.vertex[crease.from][k]));
      }
      for (unsigned e = 0; e < 3; ++e) {
        const Vector slack = L::multiply_add(edges.length[e], L::all(triangle_slope_margin), L::all(0x1p-120F));
        const Vector of_left = dot(left, edges.along[e]);
        const Vector of_right = dot(right, edges.along[e]);
        // Outwards is the normal if the left face faces along the vector.
        const Vector least = L::minimum(of_left, L::subtract(zero, of_right));
        const Vector most = L::maximum(of_left, L::subtract(zero, of_right));
        const Mask is_outward = L::less(slack, least);
        const Mask is_inward = L::less(L::add(most, slack), zero);
        Vector normal[3];
        cross(edge, edges.along[e], normal);
        const Vector at_edge = dot(normal, way[e]);
        const Vector at_vertex = dot(normal, way[(e + 2) % 3]);
        const Vector error = margin(L::all(length), edges.length[e], edges.distance);
        const Vector lower = L::minimum(at_edge, at_vertex);
        const Vector upper = L::maximum(at_edge, at_vertex);
        missed = L::either(missed, L::both(is_outward, L::less(error, lower)));
        missed = L::either(missed, L::both(is_inward, L::less(L::add(upper, error), zero)));
      }
    }
    return L::bits(missed);
  }

  const HullData& hull_;
  float below_;  ///< the margin that offsets have
  float most_;   ///< coordinate of a triangle that suits floats; −1 if none does
  float point_lo_[3];
  float point_hi_[3];
};

/// Clears the bits of triangles that miss the hull.
template <class L>
SHAFTCULL_NOINLINE void hull_triangles_stage(const HullData& hull, Contact contact, const float* const* stream,
                                             std::size_t words, std::uint64_t* kept) noexcept {
  constexpr unsigned streams = 9;
  const HullAndTriangles<L> volume(hull);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t met = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      const std::uint64_t asked = kept[w] >> lane & lanes_of<L>(0);
      if (asked == 0) continue;
      const TriangleLanes lanes = volume.lanes(stream, w * word_bits + lane, asked);
      kept[w] &= ~(lanes.missed << lane);
      met |= lanes.met << lane;
    }
    const std::uint64_t undecided = kept[w] & ~met;
    if (undecided == 0) continue;
    kept[w] &= ~decide_lanes<L>(undecided, [&](unsigned lane) {
      return triangle_misses_hull(hull, contact, BoundAt<L, streams>(stream, w * word_bits + lane).value);
    });
  }
}

}  // namespace shaftcull::kernel
