// SPDX-License-Identifier: MIT
/// Triangles against a box that moves: is there a time at which no axis separates the two?
///
/// At one time, a box and a triangle have no point in common iff one of 13 axes separates them: the three of the box,
/// the normal of the triangle, and the nine products of one of its edges and an axis (Gottschalk, Lin and Manocha,
/// *OBBTree*, 1996; Akenine-Möller, *Fast 3D Triangle–Box Overlap Testing*, 2001). None depends on the time, and the
/// extent of the moving box along each is linear in it. So every axis bounds the time from one side or from both, and
/// the triangle meets the shaft iff all of these bounds leave a time.
///
/// The *gap* along a direction is how far the box reaches over the triangle's near end: they are apart where one is
/// negative. Directions are the six of the box's axes, both of the normal, and of each edge and axis the one that
/// points inwards, in the projection along that axis. Computed gaps are off by less than a margin (docs/exactness.md).
#pragma once

#include "compiled/triangle_shaft.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// A TriangleShaft in whole vectors.
template <class L>
struct MovingBox {
  using Vector = typename L::Vector;
  Vector start[3];
  Vector half[3];
  Vector centre_slope[3];
  Vector half_slope[3];
  Vector outward_slope[6];
  Vector extent;
  Vector most;
  Vector latest;
  bool is_endless;

  explicit MovingBox(const TriangleShaft& shaft) noexcept
      : extent(L::all(shaft.extent)),
        most(L::all(shaft.most)),
        latest(L::all(shaft.is_endless ? latest_endless_time : 1.0F)),
        is_endless(shaft.is_endless) {
    for (unsigned k = 0; k < 3; ++k) {
      start[k] = L::all(shaft.start[k]);
      half[k] = L::all(shaft.half[k]);
      centre_slope[k] = L::all(shaft.centre_slope[k]);
      half_slope[k] = L::all(shaft.half_slope[k]);
    }
    for (unsigned f = 0; f < 6; ++f) outward_slope[f] = L::all(shaft.outward_slope[f]);
  }
};

/// A vector of triangles as all axes see them.
template <class L>
struct TriangleAxes {
  using Vector = typename L::Vector;
  Vector centre[3][3];  ///< of the box at time 0, as seen from each vertex
  Vector edge[3][3];    ///< from vertex e to the next one
  Vector length[3][3];  ///< of edge e on each axis
  Vector size[3][3];    ///< of edge e, projected along axis k, at [k][e]: its lengths on the other axes
  Vector normal[3];
  Vector turn[3];         ///< ±0: the sign of the normal's component
  Vector margin;          ///< of gaps along the box's axes, and of others, by the size of what they are products of
  Vector normal_margin;   ///< of gaps along the normal
  std::uint64_t certain;  ///< lanes of which floats may say anything

  /// Of the triangles at `at` in nine streams.
  TriangleAxes(const MovingBox<L>& box, const float* const* stream, std::size_t at) noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      const Vector x[3] = {L::load(stream[k] + at), L::load(stream[k + 3] + at), L::load(stream[k + 6] + at)};
      for (unsigned v = 0; v < 3; ++v) {
        centre[v][k] = L::add(L::subtract(box.start[k], x[v]), box.half[k]);
        edge[v][k] = L::subtract(x[(v + 1) % 3], x[v]);
        length[v][k] = L::magnitude(edge[v][k]);
      }
    }
    Vector extent = box.extent;
    for (unsigned k = 0; k < 3; ++k) {
      extent = L::add(extent, L::add(L::magnitude(centre[0][k]), L::add(length[0][k], length[1][k])));
    }
    margin = L::multiply_add(extent, L::all(triangle_margin), L::all(triangle_denormals));
    certain = L::bits(L::less(extent, box.most));  // not if any coordinate is not finite

    const Vector zero = L::all(0.0F);
    Vector normal_size = zero;
    Vector product[3];
    auto any_may_turn = L::less(zero, zero);
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned i = (k + 1) % 3;
      const unsigned j = (k + 2) % 3;
      for (unsigned e = 0; e < 3; ++e) size[k][e] = L::add(length[e][i], length[e][j]);
      normal[k] = L::subtract(L::multiply(edge[0][i], edge[1][j]), L::multiply(edge[0][j], edge[1][i]));
      turn[k] = L::choose(L::less(normal[k], zero), L::all(-0.0F), zero);
      product[k] = L::multiply(size[k][0], size[k][1]);
      normal_size = L::add(normal_size, product[k]);
      any_may_turn = L::either(any_may_turn, may_turn(k, product[k]));
    }
    normal_margin = L::multiply_add(normal_size, margin, L::all(triangle_normal_denormals));
    if (L::bits(any_may_turn) == 0) return;
    for (unsigned k = 0; k < 3; ++k) certain &= ~L::bits(is_turn_in_doubt(k, product[k]));
  }

  /// The margin of edge e and axis k.
  [[nodiscard]] Vector edge_margin(unsigned k, unsigned e) const noexcept {
    return L::multiply_add(size[k][e], margin, L::all(triangle_denormals));
  }
  /// How far a point that vertex e sees at `from_vertex` is inwards of edge e, times its size, along axis k.
  template <class Point>
  [[nodiscard]] Vector inwards(unsigned k, unsigned e, const Point& from_vertex) const noexcept {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    return L::flip_sign(L::subtract(L::multiply(edge[e][i], from_vertex[j]), L::multiply(edge[e][j], from_vertex[i])),
                        turn[k]);
  }
  /// How far a box of such half extents reaches from its centre in that direction.
  [[nodiscard]] Vector reach(unsigned k, unsigned e, const Vector (&half)[3]) const noexcept {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    return L::multiply_add(length[e][i], half[j], L::multiply(length[e][j], half[i]));
  }
  /// Likewise along the normal.
  template <class Point>
  [[nodiscard]] Vector along_normal(const Point& from_vertex) const noexcept {
    return L::multiply_add(normal[0], from_vertex[0],
                           L::multiply_add(normal[1], from_vertex[1], L::multiply(normal[2], from_vertex[2])));
  }
  [[nodiscard]] Vector reach_along_normal(const Vector (&half)[3]) const noexcept {
    return L::multiply_add(
        L::magnitude(normal[0]), half[0],
        L::multiply_add(L::magnitude(normal[1]), half[1], L::multiply(L::magnitude(normal[2]), half[2])));
  }
  /// The largest and the smallest coordinate of the box's centre as seen from the vertices.
  [[nodiscard]] Vector most(unsigned k) const noexcept {
    return L::maximum(centre[0][k], L::maximum(centre[1][k], centre[2][k]));
  }
  [[nodiscard]] Vector least(unsigned k) const noexcept {
    return L::minimum(centre[0][k], L::minimum(centre[1][k], centre[2][k]));
  }

 private:
  using Mask = typename L::Mask;

  /// Whether the component of the normal along axis k may have the other sign.
  [[nodiscard]] Mask may_turn(unsigned k, Vector product) const noexcept {
    return L::less(L::magnitude(normal[k]),
                   L::multiply_add(product, L::all(triangle_turn_error), L::all(triangle_denormals)));
  }
  /// Which way round a projection is may be mistaken where it is a segment, or nearly one. That does no harm, unless
  /// the edge that the normal is not computed from is much shorter than the others, or all are too short. It is not
  /// mistaken where an edge is a point, or the projection lies along an axis, and all products are 0.
  [[nodiscard]] Mask is_turn_in_doubt(unsigned k, Vector product) const noexcept {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    const Vector factors = L::maximum(L::minimum(length[0][i], length[1][j]), L::minimum(length[0][j], length[1][i]));
    const Mask is_small = L::either(L::less(L::multiply(size[k][2], L::all(2.5F)), L::maximum(size[k][0], size[k][1])),
                                    L::less(product, L::all(least_triangle_product)));
    return L::both(may_turn(k, product), L::both(is_small, L::less(L::all(0.0F), L::minimum(factors, size[k][2]))));
  }
};

/// What a vector of triangles asks of the time t, from 0 to 1: gap i, at_zero + t · slope, is 0 or more. Gaps and
/// slopes are both off by less than the margin.
template <class L>
class TriangleGaps {
  using Vector = typename L::Vector;
  using Mask = typename L::Mask;

 public:
  TriangleGaps(const MovingBox<L>& box, const TriangleAxes<L>& axes) noexcept
      : latest_(box.latest), zero_(L::all(0.0F)), certain_(axes.certain) {
    for (unsigned k = 0; k < 3; ++k) {
      set(k, L::add(box.half[k], axes.most(k)), box.outward_slope[k + 3], axes.margin);
      set(k + 3, L::subtract(box.half[k], axes.least(k)), box.outward_slope[k], axes.margin);
    }
    const Vector distance = axes.along_normal(axes.centre[0]);
    const Vector distance_slope = axes.along_normal(box.centre_slope);
    const Vector reach = axes.reach_along_normal(box.half);
    const Vector reach_slope = axes.reach_along_normal(box.half_slope);
    set(6, L::add(reach, distance), L::add(reach_slope, distance_slope), axes.normal_margin);
    set(7, L::subtract(reach, distance), L::subtract(reach_slope, distance_slope), axes.normal_margin);
    for (unsigned k = 0; k < 3; ++k) {
      for (unsigned e = 0; e < 3; ++e) {
        // An edge along the axis asks for nothing.
        const Vector at_zero = L::choose(L::less_equal(axes.size[k][e], zero_), L::all(1.0F),
                                         L::add(axes.inwards(k, e, axes.centre[e]), axes.reach(k, e, box.half)));
        const Vector slope = L::add(axes.inwards(k, e, box.centre_slope), axes.reach(k, e, box.half_slope));
        set(8 + 3 * k + e, at_zero, slope, axes.edge_margin(k, e));
      }
    }
    if (!box.is_endless) return;
    for (unsigned i = 0; i < count; ++i) slope_[i] = L::subtract(slope_[i], at_zero_[i]);
  }

  /// A time from 0 to 1: about the middle of those that all gaps allow, or between the bounds that contradict each
  /// other. Any time would be right; this one decides.
  [[nodiscard]] Vector middle() const noexcept {
    Vector from = zero_;
    Vector to = L::all(1.0F);
    for (unsigned i = 0; i < count; ++i) {
      const Vector bound = L::divide(L::subtract(zero_, at_zero_[i]), slope_[i]);
      from = L::choose(L::less(zero_, slope_[i]), L::maximum(bound, from), from);
      to = L::choose(L::less(slope_[i], zero_), L::minimum(bound, to), to);
    }
    const Vector time = L::multiply(L::add(from, to), L::all(0.5F));
    return L::maximum(L::minimum(time, latest_), zero_);
  }

  /// Bits of lanes that meet the box at this time, whatever rounding did.
  [[nodiscard]] std::uint64_t met(Vector time) const noexcept {
    Mask met = L::less(margin_[0], gap(0, time));
    for (unsigned i = 1; i < count; ++i) met = L::both(met, L::less(margin_[i], gap(i, time)));
    return L::bits(met) & certain_;
  }

  /// Bits of lanes that meet the box at no time, whatever rounding did: at this time some gap is negative that was so
  /// at all times before, and one that will be so from now on.
  [[nodiscard]] std::uint64_t missed(Vector time) const noexcept {
    Mask until_now = L::less(zero_, zero_);
    Mask from_now_on = until_now;
    for (unsigned i = 0; i < count; ++i) {
      const Mask negative = L::less(L::add(gap(i, time), margin_[i]), zero_);
      until_now = L::either(until_now, L::both(negative, L::less_equal(zero_, slope_[i])));
      from_now_on = L::either(from_now_on, L::both(negative, L::less_equal(slope_[i], zero_)));
    }
    const Mask nothing_before = L::both(from_now_on, L::less_equal(time, zero_));
    const Mask nothing_after = L::both(until_now, L::less_equal(L::all(1.0F), time));
    return L::bits(L::either(L::both(until_now, from_now_on), L::either(nothing_before, nothing_after))) & certain_;
  }

 private:
  static constexpr unsigned count = 17;

  SHAFTCULL_ALWAYS_INLINE void set(unsigned i, Vector at_zero, Vector slope, Vector margin) noexcept {
    at_zero_[i] = at_zero;
    slope_[i] = slope;
    margin_[i] = margin;
  }
  [[nodiscard]] Vector gap(unsigned i, Vector time) const noexcept {
    return L::multiply_add(time, slope_[i], at_zero_[i]);
  }

  Vector at_zero_[count];
  Vector slope_[count];
  Vector margin_[count];
  Vector latest_;
  Vector zero_;
  std::uint64_t certain_;
};

}  // namespace shaftcull::kernel
