// SPDX-License-Identifier: MIT
/// Spheres: a cheap stage that culls most, one that accepts most of the rest, and the exact predicate for what is left.
#pragma once

#include <cfloat>
#include <cmath>

#include "compiled/slab.hpp"
#include "exact/predicates.hpp"
#include "kernels/boxes/box_planes.hpp"
#include "kernels/forming/slab_constraints.hpp"
#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// A sphere's centre in place of both corners of a box.
template <class L>
struct CentreStreams {
  const float* stream[6];

  explicit CentreStreams(const float* const* sphere) noexcept {
    for (unsigned k = 0; k < 6; ++k) stream[k] = sphere[k % 3];
  }
};

/// Faces of the shaft box, or where they may lie between floats, further out.
template <class L>
struct OuterFaces {
  float face[6];

  explicit OuterFaces(const ShaftData& shaft) noexcept {
    const bool is_rounded = shaft.kind != ShaftData::Kind::between;
    for (unsigned f = 0; f < 6; ++f) {
      const float x = shaft.face[f];
      const float step = is_rounded ? fabsf(x) * (4 * float_unit) + FLT_TRUE_MIN : 0.0F;
      face[f] = f < 3 ? x - step : x + step;
    }
  }
};

/// Plane form: centres against faces and unit-normal planes moved out by the radius. Clears nothing that could meet the
/// shaft; where faces nearly coincide or are purple it serves the slab form too.
template <class L>
void sphere_planes_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                         std::uint64_t* kept) noexcept {
  const auto margin = L::all(shaft.joining_margin);
  const CentreStreams<L> centres(stream);
  const JoiningPlanes<L> planes(shaft, shaft.joining_near0, shaft.joining_near1, centres.stream);
  // The centre of a sphere that meets the shaft box is at most r beyond it, so errors grow by a few units of r.
  const auto minus_widened = L::all(-(1.0F + 8 * float_unit));
  const auto zero = L::all(0.0F);
  const auto largest = L::all(FLT_MAX);  // beyond it a sum has overflowed and proves nothing
  const OuterFaces<L> outer(shaft);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t outside = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      const std::size_t at = w * word_bits + lane;
      const auto radius = L::load(stream[3] + at);
      auto beyond = L::less(radius, zero);
      for (unsigned k = 0; k < 3; ++k) {
        const auto centre = L::load(stream[k] + at);
        // The rounded difference exceeds r only if the exact one does: r is a float.
        beyond = L::either(beyond, L::less(radius, L::subtract(L::all(outer.face[k]), centre)));
        beyond = L::either(beyond, L::less(radius, L::subtract(centre, L::all(outer.face[k + 3]))));
      }
      outside |= L::bits(beyond) << lane;
    }
    kept[w] = ~outside;
    if (kept[w] == 0) continue;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if (L::width < 8 && (kept[w] & lanes_of<L>(lane)) == 0) continue;  // as box_planes_stage()
      const std::size_t at = w * word_bits + lane;
      const auto value = L::multiply_add(L::load(stream[3] + at), minus_widened, planes.largest_value(at));
      outside |= L::bits(L::both(L::less(margin, value), L::less_equal(value, largest))) << lane;
    }
    kept[w] = ~outside;
  }
}

/// Squares of the distances of spheres' centres from box(u), u from 0 at a to 1 at b: f(u), and half of its derivative.
/// f is convex, so its value and slope at any u bound its minimum from both sides.
template <class L>
class SquareDistance {
 public:
  using Vector = typename L::Vector;

  explicit SquareDistance(const ShaftData& shaft) noexcept : shaft_(shaft) {
    const float* const a = shaft.a;
    const float* const b = shaft.b;
    const bool fused = shaft.slab_form == ShaftData::SlabForm::fused;
    float t_at_a = fused ? a[0] : 0.0F;
    float t_at_b = fused ? b[0] : 1.0F;
    if (shaft.slab_form == ShaftData::SlabForm::relative) {
      const TravelFromNearer<L> travel(shaft);
      (travel.from == a ? t_at_b : t_at_a) = travel.length;
      (travel.from == a ? t_at_a : t_at_b) = 0;
    }
    if (shaft.slab_form == ShaftData::SlabForm::endless) {
      const unsigned first_face = (shaft.slab_near[0] + 3U) % 6U;
      t_at_b = fabsf(b[first_face] - a[first_face]);
    }
    t_at_a_ = L::all(t_at_a);
    first_ = L::all(fminf(t_at_a, t_at_b));
    last_ = L::all(fmaxf(t_at_a, t_at_b));
    inverse_travel_ = L::all(1 / (t_at_b - t_at_a));
    float slopes = 0;
    for (unsigned k = 0; k < 3; ++k) {
      const float lo_slope = b[k] - a[k];
      const float hi_slope = b[k + 3] - a[k + 3];
      lo_[k] = L::all(a[k]);
      hi_[k] = L::all(a[k + 3]);
      lo_slope_[k] = L::all(lo_slope);
      minus_hi_slope_[k] = L::all(-hi_slope);
      lo_square_[k] = L::all(lo_slope * lo_slope);
      hi_square_[k] = L::all(hi_slope * hi_slope);
      slopes += fmaxf(fabsf(lo_slope), fabsf(hi_slope));
    }
    // docs/exactness.md, spheres.
    const float largest_coordinate = shaft.largest_coordinate;
    const float error = float_unit * largest_coordinate * (17 * slopes + 0x1p-13F * largest_coordinate);
    // Products with slopes may overflow: nothing is certain. Nor is it of a box that moves on from b.
    error_ = L::all(largest_coordinate > fused_regular_limit || shaft.is_endless() ? INFINITY : error);
    error_per_gap_ = L::all(float_unit * (17 * largest_coordinate + 25 * slopes));
  }

  /// A first guess at where the minimum is: the middle of those u at which box(u) meets the box around the sphere.
  [[nodiscard]] Vector guess(const Vector (&centre)[3], Vector radius) const noexcept {
    Vector upper = last_;
    Vector lower = first_;
    const auto bound = [&](unsigned i) {
      const unsigned near = shaft_.slab_near[i];
      const Vector x = near < 3 ? L::subtract(centre[near], radius) : L::add(centre[near - 3], radius);
      const Vector scale = L::all(shaft_.slab_scale[i]);
      const Vector shift = L::all(shaft_.slab_shift[i]);
      return shaft_.slab_form == ShaftData::SlabForm::fused ? L::multiply_add(x, scale, shift)
                                                            : L::multiply(L::subtract(x, shift), scale);
    };
    unsigned i = 0;
    for (; i < shaft_.slab_uppers; ++i) upper = L::minimum(bound(i), upper);
    for (; i < 6; ++i) lower = L::maximum(bound(i), lower);
    const Vector middle = L::multiply(L::all(0.5F), L::add(lower, upper));
    return clamped(L::multiply(L::subtract(middle, t_at_a_), inverse_travel_));
  }

  struct Value {
    Vector square;          ///< f
    Vector half_slope;      ///< f′ / 2
    Vector half_curvature;  ///< f″ / 2
    Vector gaps;            ///< sum of the distances on the axes
  };
  [[nodiscard]] Value at(Vector u, const Vector (&centre)[3]) const noexcept {
    const Vector zero = L::all(0.0F);
    Value value{zero, zero, zero, zero};
    for (unsigned k = 0; k < 3; ++k) {
      const Vector below = L::subtract(L::multiply_add(u, lo_slope_[k], lo_[k]), centre[k]);
      const Vector above = L::add(centre[k], L::subtract(L::multiply(u, minus_hi_slope_[k]), hi_[k]));
      const Vector under = L::maximum(below, zero);
      const Vector over = L::maximum(above, zero);
      value.square = L::multiply_add(under, under, L::multiply_add(over, over, value.square));
      value.half_slope =
          L::multiply_add(under, lo_slope_[k], L::multiply_add(over, minus_hi_slope_[k], value.half_slope));
      value.half_curvature =
          L::add(value.half_curvature,
                 L::choose(L::less(zero, below), lo_square_[k], L::choose(L::less(zero, above), hi_square_[k], zero)));
      value.gaps = L::add(value.gaps, L::add(under, over));
    }
    return value;
  }

  /// Newton's step towards the minimum, from where the value was taken.
  [[nodiscard]] Vector better(Vector u, const Value& value) const noexcept {
    const Vector zero = L::all(0.0F);
    const Vector step = L::divide(value.half_slope, value.half_curvature);
    return clamped(L::subtract(u, L::choose(L::less(zero, value.half_curvature), step, zero)));
  }

  /// A lower bound on the square for any u: the lower end of the tangent, less what rounding may have added.
  [[nodiscard]] Vector bound(Vector u, const Value& value) const noexcept {
    const Vector zero = L::all(0.0F);
    const Vector fall = L::maximum(L::multiply(u, value.half_slope),
                                   L::maximum(L::multiply(L::subtract(u, L::all(1.0F)), value.half_slope), zero));
    const Vector error = L::multiply_add(value.gaps, error_per_gap_, error_);
    const Vector tangent = L::subtract(value.square, L::add(fall, fall));
    return L::subtract(L::multiply_add(value.square, L::all(-10 * float_unit), tangent), error);
  }

 private:
  [[nodiscard]] static Vector clamped(Vector u) noexcept {
    return L::minimum(L::maximum(u, L::all(0.0F)), L::all(1.0F));
  }

  const ShaftData& shaft_;
  Vector t_at_a_;
  Vector first_;
  Vector last_;
  Vector inverse_travel_;
  Vector lo_[3];
  Vector hi_[3];
  Vector lo_slope_[3];
  Vector minus_hi_slope_[3];
  Vector lo_square_[3];
  Vector hi_square_[3];
  Vector error_;
  Vector error_per_gap_;
};

/// Accepts the kept spheres whose centre is certainly no farther than their radius from one well-chosen box between a
/// and b. Clears those that are certainly farther from all of these boxes. Asks the exact predicate about the others,
/// and about those near an added plane.
template <class L>
void sphere_distance_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                           std::uint64_t* kept) noexcept {
  using Vector = typename L::Vector;
  const SquareDistance<L> square_distance(shaft);
  // A gap is off by 8 units of the largest coordinate and one of itself; over three axes √3 · 8 < 16.
  const Vector minus_error = L::all(-17 * float_unit * shaft.largest_coordinate);
  const Vector shrink = L::all(1 - 16 * float_unit);
  const Vector grow = L::all(1 + 4 * float_unit);
  const Vector least = L::all(0x1p-60F);  // its square is far above what underflow can take away,
  const Vector most = L::all(0x1p60F);    // and the square of this far below overflow
  const Vector zero = L::all(0.0F);
  const CentreStreams<L> centres(stream);

  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t accepted = 0;
    std::uint64_t beyond = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      const Vector radius = L::load(stream[3] + at);
      const Vector centre[3] = {L::load(stream[0] + at), L::load(stream[1] + at), L::load(stream[2] + at)};
      const Vector u = square_distance.guess(centre, radius);
      const auto first = square_distance.at(u, centre);
      const Vector better = square_distance.better(u, first);
      const auto second = square_distance.at(better, centre);
      const Vector sure = L::multiply_add(radius, shrink, minus_error);
      const auto usable = L::both(L::less(least, sure), L::less(sure, most));
      const Vector least_square = L::minimum(first.square, second.square);
      accepted |= L::bits(L::both(usable, L::less_equal(least_square, L::multiply(sure, sure)))) << lane;
      const Vector square = L::multiply(L::multiply(radius, radius), grow);
      beyond |= L::bits(L::both(usable, L::less(square, square_distance.bound(better, second)))) << lane;
    }
    kept[w] &= ~beyond;
    std::uint64_t undecided = kept[w] & ~accepted;
    for (unsigned i = 0; i < shaft.added_count; ++i) {
      for (unsigned lane = 0; lane < word_bits; lane += L::width) {
        if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
        const std::size_t at = w * word_bits + lane;
        const Vector radius = L::load(stream[3] + at);
        const ShaftData::AddedPlane& plane = shaft.added[i];
        const Vector value =
            L::multiply_add(radius, L::all(-plane.length), added_value<L, Corner::near>(plane, centres.stream, at));
        const Vector margin = L::multiply_add(radius, L::all(plane.slack), L::all(plane.margin));
        const auto finite = L::less_equal(L::magnitude(value), L::all(FLT_MAX));  // a sum may have overflowed
        const std::uint64_t positive = L::bits(L::both(finite, L::less(margin, value))) << lane;
        const std::uint64_t negative = L::bits(L::both(finite, L::less(L::add(value, margin), zero))) << lane;
        kept[w] &= ~positive;
        undecided |= ~(positive | negative) & lanes_of<L>(lane);
      }
    }
    undecided &= kept[w];
    if (undecided != 0) {
      kept[w] &= ~decide_lanes<L>(undecided, [&](unsigned lane) {
        return sphere_outside(shaft, BoundAt<L, 4>(stream, w * word_bits + lane).value);
      });
    }
  }
}

/// Clears the bits of spheres that are not inside.
template <class L>
void sphere_inside_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                         std::uint64_t* inside) noexcept {
  using Vector = typename L::Vector;
  const CentreStreams<L> centres(stream);
  const OuterFaces<L> outer(shaft);
  const Vector zero = L::all(0.0F);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t candidates = 0;
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((inside[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      const Vector radius = L::load(stream[3] + at);
      auto possible = L::less_equal(zero, radius);
      auto sure = L::less_equal(zero, radius);
      for (unsigned k = 0; k < 3; ++k) {
        const Vector centre = L::load(stream[k] + at);
        const Vector above_lo = L::subtract(centre, L::all(shaft.face[k]));
        const Vector below_hi = L::subtract(L::all(shaft.face[k + 3]), centre);
        // A rounded difference that is not equal to r is on the same side of it as the exact one.
        possible = L::both(possible, L::both(L::less_equal(radius, L::subtract(centre, L::all(outer.face[k]))),
                                             L::less_equal(radius, L::subtract(L::all(outer.face[k + 3]), centre))));
        sure = L::both(sure, L::both(L::less(radius, above_lo), L::less(radius, below_hi)));
      }
      std::uint64_t within = L::bits(possible) << lane & inside[w];
      if (within == 0) continue;
      std::uint64_t certain = L::bits(sure) << lane;
      const auto test = [&](Vector value, Vector margin) {
        certain &= L::bits(L::less(L::add(value, margin), zero)) << lane;
        within &= ~(L::bits(L::less(margin, value)) << lane);
      };
      const Vector joining =
          largest_joining_value<L>(shaft, shaft.joining_near0, shaft.joining_near1, centres.stream, at);
      const Vector growth = L::all(8 * float_unit);
      test(L::add(joining, radius), L::multiply_add(radius, growth, L::all(shaft.joining_margin)));
      for (unsigned i = 0; i < shaft.added_count; ++i) {
        const ShaftData::AddedPlane& plane = shaft.added[i];
        test(L::multiply_add(radius, L::all(plane.length), added_value<L, Corner::near>(plane, centres.stream, at)),
             L::multiply_add(radius, L::all(plane.slack), L::all(plane.margin)));
      }
      candidates |= within;
      undecided |= within & ~certain;
    }
    inside[w] = candidates & ~undecided;
    if (undecided != 0) [[unlikely]] {
      inside[w] |= decide_lanes<L>(undecided, [&](unsigned lane) {
        return sphere_inside(shaft, BoundAt<L, 4>(stream, w * word_bits + lane).value);
      });
    }
  }
}

}  // namespace shaftcull::kernel
