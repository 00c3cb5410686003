// SPDX-License-Identifier: MIT
/// Planes that touch a patch and each of a vector of others, in floats that know their error: those of TangentPlanes
/// (exact/tangent_planes.hpp), a pair of patches per lane.
#pragma once

#include <cmath>

#include "exact/patch_plane.hpp"
#include "kernels/siblings/siblings.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// How far floats may be off (docs/exactness.md, "Planes that touch, in lanes"). Coordinates are those from `origin`
/// on.
struct TangentErrors {
  float origin[3];
  float of_component[3];  ///< error of a height per magnitude of a component of the normal
  float least;            ///< for what underflows
  float tolerance;
};

/// A plane in lanes, whose front has both patches if it touches them. The normal is of no certain length.
template <class L>
struct TangentInLanes {
  typename L::Vector normal[3];
  /// A point with a larger normal·p is certainly in front of the plane by more than the tolerance. −∞ if the plane
  /// certainly touches no patch, and ∞ if its front is not known.
  typename L::Vector in_front;
  /// A point with a smaller one is certainly not, and the plane certainly touches both patches.
  typename L::Vector behind;
};

template <class L>
class TangentsInLanes {
  using Vector = typename L::Vector;
  using Mask = typename L::Mask;
  struct Point {
    Vector at[3];
  };

 public:
  /// For the others from a lane on.
  TangentsInLanes(const CornersOfPairs& pairs, unsigned lane, const TangentErrors& errors) noexcept
      : pairs_(pairs), errors_(errors), infinity_(L::all(INFINITY)), none_(L::all(0.0F)) {
    for (unsigned k = 0; k < pairs.corners; ++k) {
      for (unsigned c = 0; c < 3; ++c) other_[k].at[c] = L::load(pairs.other[3 * k + c] + lane);
      for (unsigned i = 0; i < pairs.fixed_corners; ++i) {
        for (unsigned c = 0; c < 3; ++c) way_[i][k].at[c] = L::subtract(other_[k].at[c], L::all(pairs.fixed[i][c]));
      }
    }
    for (unsigned e = 0; e < pairs.fixed_edges; ++e) {
      const PatchEdge edge = pairs.fixed_edge[e];
      for (unsigned k = 0; k < pairs.corners; ++k) add_plane_of_fixed_edge(edge.from, edge.to, k);
    }
    for (unsigned e = 0; e < pairs.edges; ++e) {
      const PatchEdge edge = pairs.edge[e];
      for (unsigned k = 0; k < pairs.fixed_corners; ++k) add_plane_of_other_edge(edge.from, edge.to, k);
    }
  }
  TangentsInLanes(const TangentsInLanes&) = delete;
  TangentsInLanes& operator=(const TangentsInLanes&) = delete;

  [[nodiscard]] unsigned size() const noexcept { return size_; }
  [[nodiscard]] const TangentInLanes<L>& operator[](unsigned i) const noexcept { return plane_[i]; }
  /// Corner k of the others, from the first fixed corner.
  [[nodiscard]] const Vector (&from_origin(unsigned k) const noexcept)[3] { return way_[0][k].at; }

 private:
  /// Heights of corners above a plane, and what they say of it.
  struct Sides {
    Vector highest;
    Vector lowest;
  };

  /// The plane through a fixed edge and corner k of the others.
  void add_plane_of_fixed_edge(unsigned i, unsigned j, unsigned k) noexcept {
    Point edge;
    for (unsigned c = 0; c < 3; ++c) edge.at[c] = L::all(pairs_.fixed[j][c] - pairs_.fixed[i][c]);
    const Point& way = way_[i][k];
    begin_plane(edge, way, fixed_from_origin(i));
    is_degenerate_ = L::either(is_zero(edge), L::either(is_zero(way), is_zero(way_[j][k])));
    for (unsigned m = 0; m < pairs_.fixed_corners; ++m) {
      if (m == i || m == j) continue;
      Point to;
      for (unsigned c = 0; c < 3; ++c) to.at[c] = L::all(pairs_.fixed[m][c] - pairs_.fixed[i][c]);
      look_at(to);
    }
    for (unsigned m = 0; m < pairs_.corners; ++m) {
      if (m != k) look_at(way_[i][m]);
    }
    end_plane();
  }

  /// The plane through an edge of the others and a fixed corner.
  void add_plane_of_other_edge(unsigned i, unsigned j, unsigned k) noexcept {
    Point edge;
    Point way;
    for (unsigned c = 0; c < 3; ++c) {
      edge.at[c] = L::subtract(other_[j].at[c], other_[i].at[c]);
      way.at[c] = L::subtract(none_, way_[k][i].at[c]);
    }
    begin_plane(edge, way, way_[0][i]);
    is_degenerate_ = L::either(is_zero(edge), L::either(is_zero(way), is_zero(way_[k][j])));
    for (unsigned m = 0; m < pairs_.fixed_corners; ++m) {
      if (m == k) continue;
      Point to;
      for (unsigned c = 0; c < 3; ++c) to.at[c] = L::subtract(none_, way_[m][i].at[c]);
      look_at(to);
    }
    for (unsigned m = 0; m < pairs_.corners; ++m) {
      if (m == i || m == j) continue;
      Point to;
      for (unsigned c = 0; c < 3; ++c) to.at[c] = L::subtract(other_[m].at[c], other_[i].at[c]);
      look_at(to);
    }
    end_plane();
  }

  [[nodiscard]] Point fixed_from_origin(unsigned i) const noexcept {
    Point from;
    for (unsigned c = 0; c < 3; ++c) from.at[c] = L::all(pairs_.fixed[i][c] - errors_.origin[c]);
    return from;
  }

  [[nodiscard]] Vector product(const Vector (&a)[3], const Vector (&b)[3]) const noexcept {
    return L::multiply_add(a[2], b[2], L::multiply_add(a[1], b[1], L::multiply(a[0], b[0])));
  }

  /// Begins a plane along two ways from a point.
  void begin_plane(const Point& u, const Point& v, const Point& from) noexcept {
    TangentInLanes<L>& plane = plane_[size_];
    error_ = L::all(errors_.least);
    length_ = none_;
    for (unsigned c = 0; c < 3; ++c) {
      const unsigned d = (c + 1) % 3;
      const unsigned e = (c + 2) % 3;
      const Vector left = L::multiply(u.at[d], v.at[e]);
      const Vector right = L::multiply(u.at[e], v.at[d]);
      plane.normal[c] = L::subtract(left, right);
      length_ = L::add(length_, L::magnitude(plane.normal[c]));
      error_ =
          L::multiply_add(L::all(errors_.of_component[c]), L::add(L::magnitude(left), L::magnitude(right)), error_);
    }
    offset_ = product(plane.normal, from.at);
    highest_ = L::subtract(none_, infinity_);
    lowest_ = infinity_;
  }
  [[nodiscard]] Mask is_zero(const Point& way) const noexcept {
    const Vector sum = L::add(L::add(L::magnitude(way.at[0]), L::magnitude(way.at[1])), L::magnitude(way.at[2]));
    return L::less_equal(sum, none_);
  }

  void look_at(const Point& way) noexcept {
    const Vector height = product(plane_[size_].normal, way.at);
    highest_ = L::maximum(highest_, height);
    lowest_ = L::minimum(lowest_, height);
  }

  void end_plane() noexcept {
    TangentInLanes<L>& plane = plane_[size_];
    const Vector minus_error = L::subtract(none_, error_);
    const Mask any_above = L::less(error_, highest_);
    const Mask any_below = L::less(lowest_, minus_error);
    const Mask is_none = L::either(is_degenerate_, L::both(any_above, any_below));
    const Mask is_known = L::either(any_above, any_below);
    const Mask is_tangent = L::either(L::less(error_, lowest_), L::less(highest_, minus_error));
    for (Vector& component : plane.normal) component = L::choose(any_below, L::subtract(none_, component), component);
    const Vector offset = L::choose(any_below, L::subtract(none_, offset_), offset_);
    const Vector thickness = L::multiply(L::all(errors_.tolerance), length_);
    const Vector minus_infinity = L::subtract(none_, infinity_);
    plane.in_front = L::add(offset, L::add(thickness, error_));
    plane.in_front = L::choose(is_none, minus_infinity, L::choose(is_known, plane.in_front, infinity_));
    plane.behind = L::add(offset, L::subtract(thickness, error_));
    plane.behind = L::choose(is_none, minus_infinity, L::choose(is_tangent, plane.behind, minus_infinity));
    ++size_;
  }

  const CornersOfPairs& pairs_;
  const TangentErrors& errors_;
  const Vector infinity_;
  const Vector none_;
  Point other_[most_patch_corners];
  Point way_[most_patch_corners][most_patch_corners];  ///< from a fixed corner to one of the others
  TangentInLanes<L> plane_[CornersOfPairs::most_planes];
  unsigned size_ = 0;
  // Of the plane that is begun:
  Vector offset_;
  Vector error_;
  Vector length_;  ///< the sum of magnitudes of the normal's components
  Vector highest_;
  Vector lowest_;
  Mask is_degenerate_;  ///< whether two of its three points are equal
};

}  // namespace shaftcull::kernel
