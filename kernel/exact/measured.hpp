// SPDX-License-Identifier: MIT
/// Doubles that know how far off they are, by the rounding errors that really happened.
///
/// Most bounds that touch a shaft exactly have coordinates of few bits, so that nothing is rounded in a polynomial of
/// them. A Measured value then has the error 0 and its sign is known, ten times as fast as by expansions. Conditions
/// are those of expansion.hpp.
#pragma once

#include <cmath>

#include "exact/expansion.hpp"

namespace shaftcull::kernel {

/// A double and a bound on its distance from the real number that it stands for.
///
/// The bound is a sum of products of doubles and rounded itself, each time by 2⁻⁵³ of it at most; is_known() allows for
/// thousands of such roundings.
class Measured {
 public:
  Measured() noexcept = default;
  explicit Measured(double value) noexcept : value_(value) {}

  /// The value a − b.
  static Measured difference(double a, double b) noexcept { return Measured(two_sum(a, -b), 0); }

  /// Whether the sign of the value is that of the real number.
  [[nodiscard]] bool is_known() const noexcept { return error_ == 0 || std::fabs(value_) > (1 + 0x1p-40) * error_; }
  [[nodiscard]] bool is_negative() const noexcept { return value_ < 0 && is_known(); }
  [[nodiscard]] bool is_positive() const noexcept { return value_ > 0 && is_known(); }
  [[nodiscard]] bool is_not_positive() const noexcept { return value_ <= 0 && is_known(); }
  [[nodiscard]] bool is_not_negative() const noexcept { return value_ >= 0 && is_known(); }

  /// Adds one double.
  void grow(double value) noexcept { *this = *this + Measured(value); }

  friend Measured operator-(const Measured& a) noexcept {
    Measured negated = a;
    negated.value_ = -a.value_;
    return negated;
  }
  friend Measured operator+(const Measured& a, const Measured& b) noexcept {
    return Measured(two_sum(a.value_, b.value_), a.error_ + b.error_);
  }
  friend Measured operator-(const Measured& a, const Measured& b) noexcept { return a + -b; }
  friend Measured operator*(const Measured& a, const Measured& b) noexcept {
    return Measured(two_product(a.value_, b.value_),
                    std::fabs(a.value_) * b.error_ + a.error_ * (std::fabs(b.value_) + b.error_));
  }

 private:
  Measured(const TwoTerms& rounded, double error) noexcept
      : value_(rounded.sum), error_(error + std::fabs(rounded.error)) {}

  double value_ = 0;
  double error_ = 0;
};

}  // namespace shaftcull::kernel
