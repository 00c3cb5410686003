// SPDX-License-Identifier: MIT
/// The slab form: the interval of t between box a's and box b's that all six constraints of a shaft allow.
#pragma once

#include <cfloat>
#include <cmath>

#include "compiled/slab.hpp"
#include "kernels/forming/slab_constraints.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// How many constraints bound t from above: so many, or what the shaft says. Loops over whole words know it when they
/// are compiled; what tests less is compiled once for all shafts.
inline constexpr unsigned any_uppers = 7;
template <class L, unsigned known>
struct Uppers {
  static constexpr unsigned count = known;
  explicit Uppers(const ShaftData& /*shaft*/) noexcept {}
};
template <class L>
struct Uppers<L, any_uppers> {
  unsigned count;
  explicit Uppers(const ShaftData& shaft) noexcept : count(shaft.slab_uppers) {}
};

/// A compiled shaft's slab constraints in registers, those that bound t from above first.
template <class L, unsigned known_uppers, ShaftData::SlabForm form>
struct Slab {
  static constexpr bool fused = form == ShaftData::SlabForm::fused;
  static constexpr bool relative = form == ShaftData::SlabForm::relative;
  static constexpr bool endless = form == ShaftData::SlabForm::endless;
  using Vector = typename L::Vector;
  Vector scale[6];
  Vector shift[6];
  Vector begin;
  Vector end;
  Vector margin;
  Vector two_margins;
  Vector narrower;  ///< 1 ∓ the margin, in the relative form
  Vector wider;
  Vector direction;  ///< of the first face, in the endless form: −0 if it moves down
  [[no_unique_address]] Uppers<L, known_uppers> uppers;

  Slab(const ShaftData& shaft, float error_margin, bool exactly) noexcept
      : margin(L::all(error_margin)), two_margins(L::all(2 * error_margin)), uppers(shaft) {
    const float t_at_a = fused ? shaft.a[0] : 0.0F;
    const float t_at_b = fused ? shaft.b[0] : 1.0F;
    begin = L::all(t_at_a < t_at_b ? t_at_a : t_at_b);
    end = L::all(t_at_a < t_at_b ? t_at_b : t_at_a);
    for (unsigned i = 0; i < 6; ++i) {
      scale[i] = L::all(shaft.slab_scale[i]);
      shift[i] = L::all(shaft.slab_shift[i]);
    }
    if constexpr (relative) {
      end = L::all(TravelFromNearer<L>(shaft).length);
      narrower = L::all(1 - error_margin);
      wider = L::all(1 + error_margin);
      two_margins = L::all(FLT_MAX);
    }
    if constexpr (endless) {  // lower bounds carry the margin
      float denormals = relative_denormals;
      if (!exactly) {  // corners of spheres are rounded once more, relatively to where they are
        float largest = 0;
        for (unsigned i = 0; i < 6; ++i) {
          const float shifted = fabsf(shaft.slab_shift[i] * shaft.slab_scale[i]);
          if (shifted <= FLT_MAX) largest = shifted > largest ? shifted : largest;  // purple faces need none
        }
        denormals += endless_corner_margin * largest;
      }
      begin = L::all(-denormals);
      end = L::all(FLT_MAX);
      direction = L::all(shaft.slab_scale[0] < 0 ? -0.0F : 0.0F);
      narrower = L::all(-(1 + endless_kept_per_margin * error_margin));
      margin = L::all(3 * denormals);
      two_margins = L::all(FLT_MAX);
      for (unsigned i = uppers.count; i < 6; ++i) scale[i] = L::all(shaft.slab_scale[i] * (1 - error_margin));
    }
    if constexpr (fused) {  // lower bounds carry the margin
      begin = L::subtract(begin, margin);
      for (unsigned i = uppers.count; i < 6; ++i) shift[i] = L::subtract(shift[i], margin);
    }
  }

  /// The bound on t that coordinate x puts through constraint i.
  [[nodiscard]] Vector bound(unsigned i, Vector x) const noexcept {
    if constexpr (fused) {
      return i == 0 ? x : L::multiply_add(x, scale[i], shift[i]);
    } else if constexpr (endless) {
      const Vector distance = L::subtract(x, shift[i]);
      return i == 0             ? L::flip_sign(distance, direction)
             : i < uppers.count ? L::multiply(distance, scale[i])
                                : L::multiply_add(distance, scale[i], begin);
    } else {
      return L::multiply(L::subtract(x, shift[i]), scale[i]);
    }
  }

  /// Length of the interval of t that all constraints allow, plus the margin: smallest upper bound − largest lower
  /// bound + margin. Negative if certainly outside, above two margins if certainly not. coordinate(i) is what
  /// constraint i reads. Never NaN, because minimum and maximum pass over a NaN in their first argument. A bound that
  /// is read and not computed may be a signalling NaN. Of zeros either will do: no margin is so close
  /// (docs/exactness.md).
  template <class Coordinate>
  [[nodiscard]] Vector interval_length(Coordinate coordinate) const noexcept {
    if constexpr (endless) {
      Vector excess;
      const Vector length = endless_length(coordinate, excess);
      return L::choose(L::less_equal(L::all(0.0F), excess), L::all(INFINITY), length);
    }
    // Its own loop, not one that endless_length() shares: g++ 12 then puts four scalar lanes into a register.
    Vector upper = end;
    Vector lower = begin;
    SHAFTCULL_UNROLL(6)
    for (unsigned i = 0; i < 6; ++i) {
      const Vector t = bound(i, coordinate(i));
      if (i < uppers.count) {
        upper = fused && i == 0 ? L::minimum(t, upper) : L::minimum_of_computed(t, upper);
      } else {
        lower = L::maximum_of_computed(t, lower);
      }
    }
    if constexpr (fused) {
      return L::subtract(upper, lower);
    } else if constexpr (relative) {
      // No length here, but with the same signs: +∞ if certainly not outside, negative if certainly outside, else
      // undecided.
      const Vector least = L::multiply_add(upper, narrower, L::all(-relative_denormals));
      const Vector most = L::multiply_add(upper, wider, L::all(relative_denormals));
      return L::choose(L::less_equal(lower, least), L::all(INFINITY), L::subtract(most, lower));
    } else {
      return L::subtract(margin, L::subtract(lower, upper));
    }
  }

  /// The same in the endless form: negative if certainly outside. If not, then `excess` is negative unless it is
  /// certainly not outside.
  template <class Coordinate>
  [[nodiscard]] Vector endless_length(Coordinate coordinate, Vector& excess) const noexcept {
    Vector upper = end;
    Vector lower = begin;
    SHAFTCULL_UNROLL(6)
    for (unsigned i = 0; i < 6; ++i) {
      const Vector t = bound(i, coordinate(i));
      if (i < uppers.count) {
        upper = L::minimum(t, upper);
      } else {
        lower = L::maximum(t, lower);
      }
    }
    lower = L::minimum(lower, end);  // of bounds that are met later than at any float, if they are infinite
    excess = L::multiply_add(lower, narrower, L::subtract(upper, margin));
    return L::subtract(upper, lower);
  }
};

}  // namespace shaftcull::kernel
