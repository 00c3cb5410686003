// SPDX-License-Identifier: MIT
/// The first step of the distance between a sphere's centre and a shaft: doubles, with a bound on their own error.
#pragma once

#include <cmath>

#include "exact/gap.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// The two gaps of an axis, side by side. Where a processor has no such vectors, compilers make two doubles of it.
using Two = CompilerVector<double, 2>::Type;

inline double sum(Two x) noexcept { return x[0] + x[1]; }

/// x where it is positive, and 0 elsewhere; without a branch, which would be mispredicted.
inline Two where_positive(Two x, Two condition) noexcept { return condition > 0 ? x : Two{}; }

inline double larger(double x, double y) noexcept { return x < y ? y : x; }

/// Gaps in doubles, and f as they give it.
class RoundedGaps {
 public:
  explicit RoundedGaps(const Gaps& gaps) noexcept {
    double largest_start = 0;
    double largest_slope = 0;
    slopes_ = 0;
    end_ = gaps.is_endless() ? 0 : gaps.end_minuend - gaps.end_subtrahend;
    for (unsigned g = 0; g < gaps.count; ++g) {
      const double start = gaps.gap[g].start();
      const double slope = gaps.gap[g].slope();
      start_[g / 2][g % 2] = start;
      slope_[g / 2][g % 2] = slope;
      slopes_ += std::fabs(slope);
      largest_start = larger(largest_start, std::fabs(start));
      largest_slope = larger(largest_slope, std::fabs(slope));
      // Without an end, up to where the last gap that shrinks is zero, and a bit further for the rounding of that.
      if (gaps.is_endless() && start > 0 && slope < 0) end_ = larger(end_, start / -slope * (1 + 8 * unit));
    }
    ends_ = !gaps.is_endless();
    // A gap is off by at most 4 units of the largest terms: its start and slope by one each, product and sum by one
    // each.
    gap_error_ = 4 * unit * (largest_start + end_ * largest_slope);
  }

  /// Whether all gaps in `some` (gap g as bit g) are the same for every t.
  [[nodiscard]] bool are_constant(unsigned some) const noexcept {
    bool constant = true;
    for (unsigned g = 0; g < 6; ++g) constant = constant && ((some >> g & 1U) == 0 || slope_[g / 2][g % 2] == 0);
    return constant;
  }

  /// Decides in double arithmetic, with a bound on its own error, or tells where f seems to be least.
  ///
  /// f is convex. If it neither rises from t = 0 on nor falls up to the end, it is least where its derivative is 0. The
  /// derivative is linear while the same gaps are positive, so a few of Newton's steps lead there, kept from going
  /// round in circles by the interval between steps that led to either side.
  Verdict decide(double radius, Minimum& least) const noexcept {
    constexpr unsigned most_steps = 16;
    const double radius_square = radius * radius;  // exact: 24-bit factor
    const Value at_start = at(0);
    const Value at_end = at(end_);
    Value value = at(0.5 * end_);  // all three at once take hardly longer than one
    if (at_start.half_slope >= 0 || (ends_ && at_end.half_slope <= 0)) {
      const bool is_at_end = at_start.half_slope < 0;
      least = {is_at_end ? Minimum::Where::end : Minimum::Where::start, 0};
      return compare(is_at_end ? at_end : at_start, is_at_end ? end_ : 0, radius_square);
    }
    double t = 0.5 * end_;
    double low = 0;
    double high = end_;
    for (unsigned step = 0; step < most_steps; ++step) {
      const Verdict verdict = compare(value, t, radius_square);
      if (verdict != Verdict::undecided) return verdict;
      if (std::fabs(value.half_slope) <= half_slope_error(value)) break;
      (value.half_slope < 0 ? low : high) = t;
      const double next = t - value.half_slope / value.curvature;
      t = next > low && next < high ? next : 0.5 * (low + high);
      value = at(t);
    }
    least = {Minimum::Where::between, positive(t)};
    return Verdict::undecided;
  }

 private:
  static constexpr double unit = 0x1p-53;

  struct Value {
    double square;      // f
    double half_slope;  // f′ / 2
    double curvature;   // f″ / 2
    double gaps;        // sum of the positive ones
  };

  // Of errors, twice what is needed pays for the rounding of the bounds themselves.

  [[nodiscard]] double square_error(const Value& value) const noexcept {
    return 4 * gap_error_ * (value.gaps + 3 * gap_error_) + 16 * unit * value.square;
  }
  [[nodiscard]] double half_slope_error(const Value& value) const noexcept {
    return 2 * slopes_ * (gap_error_ + 4 * unit * value.gaps);
  }

  /// As f is convex, min f ≤ f(t), and min f ≥ f(t) + min(f′(t) (0 − t), f′(t) (end − t), 0).
  [[nodiscard]] Verdict compare(const Value& value, double t, double radius_square) const noexcept {
    if (value.square + square_error(value) < radius_square) return Verdict::meets;
    const double descent =
        larger(value.half_slope * t, -value.half_slope * (end_ - t)) + end_ * half_slope_error(value);
    const double least = value.square - square_error(value) - 2 * larger(descent, 0.0) * (1 + 4 * unit);
    return least * (1 - 8 * unit) > radius_square ? Verdict::outside : Verdict::undecided;
  }

  [[nodiscard]] Value at(double t) const noexcept {
    Two square{};
    Two half_slope{};
    Two curvature{};
    Two sum_of_gaps{};
    for (unsigned k = 0; k < 3; ++k) {
      const Two value = start_[k] + t * slope_[k];
      const Two gap = where_positive(value, value);
      square += gap * gap;
      half_slope += gap * slope_[k];
      curvature += where_positive(slope_[k] * slope_[k], value);
      sum_of_gaps += gap;
    }
    return {sum(square), sum(half_slope), sum(curvature), sum(sum_of_gaps)};
  }

  [[nodiscard]] unsigned positive(double t) const noexcept {
    unsigned bits = 0;
    for (unsigned k = 0; k < 3; ++k) {
      const Two value = start_[k] + t * slope_[k];
      bits |= static_cast<unsigned>(value[0] > 0) << 2 * k | static_cast<unsigned>(value[1] > 0) << (2 * k + 1);
    }
    return bits;
  }

  Two start_[3] = {};
  Two slope_[3] = {};
  double end_;     // of t, or beyond where f is least
  bool ends_;      // whether t does
  double slopes_;  // sum of their magnitudes
  double gap_error_;
};

}  // namespace shaftcull::kernel
