// SPDX-License-Identifier: MIT
/// Points and vectors of three doubles.
#pragma once

#include <array>
#include <cmath>

#include "shaftcull/bounds.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

using Double3 = std::array<double, 3>;

[[nodiscard]] inline Double3 in_doubles(const Vec3& p) noexcept { return {double{p[0]}, double{p[1]}, double{p[2]}}; }
[[nodiscard]] inline Double3 operator-(const Double3& p, const Double3& q) noexcept {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}
[[nodiscard]] inline double dot(const Double3& p, const Double3& q) noexcept {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
[[nodiscard]] inline Double3 cross(const Double3& p, const Double3& q) noexcept {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
/// The way from p to q.
[[nodiscard]] inline Double3 between(const Vec3& p, const Vec3& q) noexcept { return in_doubles(q) - in_doubles(p); }
[[nodiscard]] inline double length(const Double3& p) noexcept { return std::sqrt(dot(p, p)); }

}  // namespace shaftcull::kernel
