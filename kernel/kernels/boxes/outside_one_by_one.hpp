// SPDX-License-Identifier: MIT
/// Boxes outside the shaft, in slab form, one box at a time: the lanes of a vector hold the constraints of the shaft.
/// For few boxes that lie apart, which then need not be gathered, nor the shaft be broadcast.
#pragma once

#include <cfloat>
#include <cmath>

#include "compiled/slab.hpp"
#include "exact/predicates.hpp"
#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// The slab constraints of a shaft in six lanes, and the ends of t in the last two.
template <class L>
class SlabInLanes {
 public:
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;

  [[nodiscard]] static bool suits(const ShaftData& shaft) noexcept {
    return shaft.slab_form == ShaftData::SlabForm::fused;
  }

  explicit SlabInLanes(const ShaftData& shaft) noexcept
      : corner_(EightFloats::order(row_of(shaft, ShaftRow::selectors))),
        is_upper_(EightFloats::first_and_seventh(shaft.slab_uppers)),
        scale_(EightFloats::load(row_of(shaft, ShaftRow::scale))),
        two_margins_(2 * shaft.slab_margin) {
    // As in Slab, lower bounds carry the margin.
    const Vector margin = EightFloats::choose(is_upper_, EightFloats::all(0.0F), EightFloats::all(shaft.slab_margin));
    ends_ = EightFloats::subtract(EightFloats::sorted_last_two(shaft.a[0], shaft.b[0]), margin);
    // What follows the six shifts in memory are bytes, which may be denormals as floats: those take a hundred cycles.
    shift_ = EightFloats::with_last_two(
        EightFloats::subtract(EightFloats::load(row_of(shaft, ShaftRow::shift)), margin), ends_);
  }

  /// As Slab::interval_length(), of a box whose faces are in the first six lanes.
  [[nodiscard]] float interval_length(Vector box) const noexcept {
    const Vector bound = EightFloats::with_last_two(
        EightFloats::multiply_add(EightFloats::permuted(box, corner_), scale_, shift_), ends_);
    const Vector signed_bound = EightFloats::infinite_if_nan(EightFloats::negate_unless(is_upper_, bound));
    const Vector none = EightFloats::all(INFINITY);
    return EightFloats::sum_of_smallest(EightFloats::choose(is_upper_, signed_bound, none),
                                        EightFloats::choose(is_upper_, none, signed_bound));
  }
  [[nodiscard]] float two_margins() const noexcept { return two_margins_; }

 private:
  typename EightFloats::Order corner_;
  typename EightFloats::Mask is_upper_;
  Vector scale_;
  Vector shift_;
  Vector ends_;
  float two_margins_;
};

/// Likewise of a shaft in the endless form. The arithmetic of Slab, in another order.
template <class L>
class EndlessSlabInLanes {
 public:
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;

  [[nodiscard]] static bool suits(const ShaftData& shaft) noexcept {
    return shaft.slab_form == ShaftData::SlabForm::endless;
  }

  explicit EndlessSlabInLanes(const ShaftData& shaft) noexcept
      : corner_(EightFloats::order(row_of(shaft, ShaftRow::selectors))),
        is_upper_(EightFloats::first_and_seventh(shaft.slab_uppers)),
        kept_factor_(EightFloats::all(1 + endless_kept_per_margin * shaft.slab_margin)) {
    const Vector scale = EightFloats::load(row_of(shaft, ShaftRow::scale));
    scale_ =
        EightFloats::choose(is_upper_, scale, EightFloats::multiply(scale, EightFloats::all(1 - shaft.slab_margin)));
    added_ = EightFloats::choose(is_upper_, EightFloats::all(0.0F), EightFloats::all(-relative_denormals));
    ends_ = EightFloats::sorted_last_two(FLT_MAX, -relative_denormals);
    p_ = EightFloats::with_last_two(EightFloats::load(row_of(shaft, ShaftRow::shift)), EightFloats::all(0.0F));
  }

  /// Negative if a box, whose faces are in the first six lanes, is certainly outside; above two_margins() if it
  /// certainly is not.
  [[nodiscard]] float interval_length(Vector box) const noexcept {
    const Vector distance = EightFloats::subtract(EightFloats::permuted(box, corner_), p_);
    const Vector bound = EightFloats::with_last_two(EightFloats::multiply_add(distance, scale_, added_), ends_);
    const Vector signed_bound = EightFloats::infinite_if_nan(EightFloats::negate_unless(is_upper_, bound));
    const Vector none = EightFloats::all(INFINITY);
    const Vector upper = EightFloats::choose(is_upper_, signed_bound, none);
    const Vector minus_lower = EightFloats::choose(is_upper_, none, signed_bound);
    const float length = EightFloats::sum_of_smallest(upper, minus_lower);
    const float excess = EightFloats::sum_of_smallest(upper, EightFloats::multiply(minus_lower, kept_factor_));
    return excess > 4 * relative_denormals ? INFINITY : length;
  }
  [[nodiscard]] float two_margins() const noexcept { return FLT_MAX; }

 private:
  typename EightFloats::Order corner_;
  typename EightFloats::Mask is_upper_;
  Vector kept_factor_;
  Vector scale_;
  Vector added_;
  Vector ends_;
  Vector p_;
};

/// Which of the boxes in `lanes` of the word at `first` are outside of a shaft that `SlabType` suits.
template <class L, class SlabType = SlabInLanes<L>>
std::uint64_t outside_one_by_one(const ShaftData& shaft, const float* const* stream, std::size_t first,
                                 std::uint64_t lanes) noexcept {
  const SlabType slab(shaft);
  std::uint64_t outside = 0;
  std::uint64_t undecided = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const unsigned lane = L::lowest_bit(lanes);
    const float length = slab.interval_length(L::EightFloats::gather(stream, first + lane));
    outside |= static_cast<std::uint64_t>(length < 0) << lane;
    undecided |= static_cast<std::uint64_t>((length >= 0) & (length <= slab.two_margins())) << lane;
  }
  if (undecided == 0) [[likely]]
    return outside;
  const SlabPredicate exact(shaft);
  return outside | decide_lanes<L>(undecided, [&](unsigned lane) {
           return exact.outside(BoundAt<L, 6>(stream, first + lane).value);
         });
}

}  // namespace shaftcull::kernel
