// SPDX-License-Identifier: MIT
/// The slab constraints of one shaft: its six faces in the lanes of one vector.
///
/// The arithmetic of slab_constraints.hpp, operation by operation, so that a shaft formed alone has the bits of one
/// formed in a batch.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstring>

#include "kernels/forming/slab_constraints.hpp"

namespace shaftcull::kernel {

/// The slab constraints of one shaft in the fused form, and whether they suit it. The last two lanes of vectors repeat
/// faces, which changes no minimum or maximum.
template <class L>
struct SlabOfPair {
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;

  Vector p;      ///< the faces where they start
  Vector other;  ///< and where they end
  Vector scale;  ///< 1 for the reference face
  Vector shift;
  float largest_coordinate;
  float margin;
  bool is_finite;  ///< both boxes, with lo ≤ hi
  bool fused_suits;

  SHAFTCULL_ALWAYS_INLINE SlabOfPair(Vector from, Vector to) noexcept : p(from), other(to) {
    const Vector slope = EightFloats::subtract(other, p);
    scale = EightFloats::divide(EightFloats::first_in_all(slope), slope);
    shift = EightFloats::subtract(EightFloats::first_in_all(p), EightFloats::multiply(p, scale));
    const auto largest =
        EightFloats::largest_of_three(EightFloats::maximum(EightFloats::magnitude(p), EightFloats::magnitude(other)),
                                      EightFloats::magnitude(shift), EightFloats::minus_magnitude(slope));
    largest_coordinate = largest.of[0];
    const float largest_shift = largest.of[1];
    const float least_slope = -largest.of[2];
    is_finite = EightFloats::is_ordered(p) && EightFloats::is_ordered(other) && largest_coordinate <= FLT_MAX;
    const float length = fabsf(EightFloats::first(slope));
    const float start = fabsf(EightFloats::first(p));
    const float end = fabsf(EightFloats::first(other));
    const float position = (start > end ? start : end) + largest_shift;
    fused_suits = largest_coordinate <= fused_regular_limit && 1 / fused_regular_limit <= least_slope &&
                  position <= length * fused_limit;
    margin = position * fused_margin_per_position + length * fused_margin_per_travel;
  }

  /// Whether no other form is better.
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] bool is_plain() const noexcept {
    return fused_suits && largest_coordinate <= largest_plain_coordinate;
  }

  /// Writes both boxes, the constraints and the flags behind the boxes, with a wider margin, and coordinates that may
  /// be as much larger.
  SHAFTCULL_ALWAYS_INLINE void write(TwoFloats flags, float wider, ShaftData& out) const noexcept {
    EightFloats::store(row_of(out, ShaftRow::a), p);
    EightFloats::store(row_of(out, ShaftRow::b),
                       EightFloats::with_last_two(other, EightFloats::pair_in_all(flags.of[0], flags.of[1])));
    const SlabOrder& order = slab_orders.by_negative[EightFloats::signs(scale) & 0x3f];
    EightFloats::store(
        row_of(out, ShaftRow::scale),
        EightFloats::permuted(
            EightFloats::with_last_two(scale, EightFloats::pair_in_all(margin * wider, largest_coordinate * wider)),
            order.face));
    EightFloats::store(row_of(out, ShaftRow::shift), EightFloats::permuted(shift, order.face));
    std::memcpy(row_of(out, ShaftRow::selectors), &order.selectors, sizeof order.selectors);
  }
};

/// Compiles the shaft between boxes `a` and `b`; joining planes are left pending. Returns false, and leaves `out` as it
/// was, if a box is not finite with lo ≤ hi.
template <class L>
bool compile_pair(const Box& a, const Box& b, ShaftData& out) noexcept {
  using EightFloats = typename L::EightFloats;
  const SlabOfPair<L> slab(EightFloats::load_faces(&a), EightFloats::load_faces(&b));
  if (!slab.is_finite) [[unlikely]]
    return false;
  slab.write(batch_flags, 1, out);
  if (!slab.is_plain()) [[unlikely]]
    rewrite_slab<L>(out, slab.fused_suits);
  return true;
}

}  // namespace shaftcull::kernel
