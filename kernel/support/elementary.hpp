// SPDX-License-Identifier: MIT
/// Logarithm and arc tangent of additions, products, quotients and roots alone. Those are rounded in one way
/// everywhere, so these functions have the same bits on every machine. Those of the C library do not.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

inline constexpr double pi = 3.14159265358979324;

/// The natural logarithm of a positive number that is finite and no denormal, off by a few units in the last place.
[[nodiscard]] inline double logarithm(double x) noexcept {
  constexpr double ln_2 = 0.693147180559945309;
  constexpr std::uint64_t root_half = 0x3fe6a09e667f3bcd;
  // x = m 2^e with m from √½ to √2. ln m = 2 artanh f with f = (m − 1) / (m + 1), |f| < 0.172.
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto exponent = static_cast<std::int64_t>(bits - root_half) >> 52;
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(exponent) << 52));
  const double f = (m - 1) / (m + 1);
  const double square = f * f;
  double series = 0;
  for (int k = 21; k >= 1; k -= 2) series = series * square + 1.0 / k;
  return static_cast<double>(exponent) * ln_2 + 2 * f * series;
}

/// The angle from 0 to π of a point (x, y), with y of 0 or more, likewise. 0 of (0, 0).
[[nodiscard]] inline double angle_of(double y, double x) noexcept {
  if (y == 0) return x < 0 ? pi : 0;
  const double magnitude = std::fabs(x);
  const bool is_steep = y > magnitude;
  double tangent = is_steep ? magnitude / y : y / magnitude;
  // Twice half of the angle: then the tangent is at most that of π / 16.
  double times = 1;
  for (int halved = 0; halved != 2; ++halved) {
    tangent /= 1 + std::sqrt(1 + tangent * tangent);
    times *= 2;
  }
  const double square = tangent * tangent;
  double series = 0;
  for (int k = 23; k >= 1; k -= 2) series = (k % 4 == 1 ? 1.0 : -1.0) / k + series * square;
  const double angle = times * tangent * series;
  const double acute = is_steep ? pi / 2 - angle : angle;
  return x < 0 ? pi - acute : acute;
}

}  // namespace shaftcull::kernel
