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

/// Compiles the shaft between boxes `a` and `b`; joining planes are left pending. Returns false, and leaves `out` as it
/// was, if a box is not finite with lo ≤ hi.
template <class L>
bool compile_pair(const Box& a, const Box& b, ShaftData& out) noexcept {
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;

  // The last two lanes repeat faces, which changes no minimum or maximum.
  const Vector p = EightFloats::load_faces(&a);
  const Vector other = EightFloats::load_faces(&b);
  const Vector slope = EightFloats::subtract(other, p);
  const Vector slope_0 = EightFloats::first_in_all(slope);
  const Vector scale = EightFloats::divide(slope_0, slope);  // 1 for the reference face
  const Vector shift = EightFloats::subtract(EightFloats::first_in_all(p), EightFloats::multiply(p, scale));
  const auto largest =
      EightFloats::largest_of_three(EightFloats::maximum(EightFloats::magnitude(p), EightFloats::magnitude(other)),
                                    EightFloats::magnitude(shift), EightFloats::minus_magnitude(slope));
  const float largest_coordinate = largest.of[0];
  const float largest_shift = largest.of[1];
  const float least_slope = -largest.of[2];

  if (!(EightFloats::is_ordered(p) && EightFloats::is_ordered(other) && largest_coordinate <= FLT_MAX)) [[unlikely]]
    return false;
  EightFloats::store(row_of(out, ShaftRow::a), p);
  EightFloats::store(row_of(out, ShaftRow::b),
                     EightFloats::with_last_two(other, EightFloats::pair_in_all(batch_flags.of[0], batch_flags.of[1])));

  const float length = fabsf(EightFloats::first(slope));
  const float from = fabsf(EightFloats::first(p));
  const float to = fabsf(EightFloats::first(other));
  const float position = (from > to ? from : to) + largest_shift;
  const bool fused_suits = largest_coordinate <= fused_regular_limit && 1 / fused_regular_limit <= least_slope &&
                           position <= length * fused_limit;
  const float margin = position * fused_margin_per_position + length * fused_margin_per_travel;
  const SlabOrder& order = slab_orders.by_negative[EightFloats::signs(scale) & 0x3f];
  EightFloats::store(
      row_of(out, ShaftRow::scale),
      EightFloats::permuted(EightFloats::with_last_two(scale, EightFloats::pair_in_all(margin, largest_coordinate)),
                            order.face));
  EightFloats::store(row_of(out, ShaftRow::shift), EightFloats::permuted(shift, order.face));
  std::memcpy(row_of(out, ShaftRow::selectors), &order.selectors, sizeof order.selectors);
  if (!(fused_suits && largest_coordinate <= largest_plain_coordinate)) [[unlikely]]
    rewrite_slab<L>(out, fused_suits);
  return true;
}

}  // namespace shaftcull::kernel
