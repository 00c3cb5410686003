// SPDX-License-Identifier: MIT
/// Intervals of doubles that certainly contain the real result.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace shaftcull::oracle {

/// All real numbers from lo to hi.
struct Interval {
  double lo;
  double hi;

  /// One number, exactly.
  constexpr explicit Interval(double x) : lo(x), hi(x) {}
  constexpr Interval(double low, double high) : lo(low), hi(high) {}

  /// The interval of what was computed as low and high, each rounded once. |x| 2⁻⁵² is an ulp of x or more and a
  /// rounding error half of one; the constant pays for those of denormals.
  static Interval around(double low, double high) {
    return {low - (std::fabs(low) * 0x1p-52 + 0x1p-1070), high + (std::fabs(high) * 0x1p-52 + 0x1p-1070)};
  }
};

inline Interval operator-(Interval x) { return {-x.hi, -x.lo}; }
inline Interval operator+(Interval x, Interval y) { return Interval::around(x.lo + y.lo, x.hi + y.hi); }
inline Interval operator-(Interval x, Interval y) { return Interval::around(x.lo - y.hi, x.hi - y.lo); }

inline Interval operator*(Interval x, Interval y) {
  const std::initializer_list<double> ends = {x.lo * y.lo, x.lo * y.hi, x.hi * y.lo, x.hi * y.hi};
  return Interval::around(std::min(ends), std::max(ends));
}

/// 0 is not in y.
inline Interval operator/(Interval x, Interval y) {
  const std::initializer_list<double> ends = {x.lo / y.lo, x.lo / y.hi, x.hi / y.lo, x.hi / y.hi};
  return Interval::around(std::min(ends), std::max(ends));
}

inline Interval minimum(Interval x, Interval y) { return {std::min(x.lo, y.lo), std::min(x.hi, y.hi)}; }
inline Interval maximum(Interval x, Interval y) { return {std::max(x.lo, y.lo), std::max(x.hi, y.hi)}; }

inline Interval square(Interval x) {
  const Interval product = x * x;
  return {std::max(product.lo, 0.0), product.hi};
}

inline bool certainly_less(Interval x, Interval y) { return x.hi < y.lo; }
inline bool certainly_at_most(Interval x, Interval y) { return x.hi <= y.lo; }

}  // namespace shaftcull::oracle
