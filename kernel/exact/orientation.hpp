// SPDX-License-Identifier: MIT
/// On which side of a plane through vertices of a hull a point is: signs of determinants, exactly.
///
/// Doubles with a bound on their error decide nearly always. Of the others, most are 0. Two products of differences
/// that doubles have without rounding are compared with their rounding errors. A determinant of three vectors keeps its
/// sign if all steps along one axis are multiplied by a power of two; differences of floats are whole numbers then, and
/// unless their sizes differ very much, integers of 128 bits decide in a tenth of the time of expansions, which decide
/// the rest. (J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
/// Discrete & Computational Geometry 18, 1997.) Coordinates are floats, so that no product of three differences over-
/// or underflows.
#pragma once

#include <cmath>

#include "shaftcull/bounds.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// A vector between two points, or a direction: `end` − `start`, coordinate by coordinate.
struct Step {
  double end;
  double start;  ///< 0 for a direction

  [[nodiscard]] double rounded() const noexcept { return end - start; }
  template <class Number>
  [[nodiscard]] Number in() const noexcept {
    return Number::difference(end, start);
  }
};

/// From one point to another.
struct Steps {
  Step of[3];

  Steps(const Vec3& from, const Vec3& to) noexcept
      : of{{double{to[0]}, double{from[0]}}, {double{to[1]}, double{from[1]}}, {double{to[2]}, double{from[2]}}} {}
};

/// a · d − b · c in the arithmetic of `Number`.
template <class Number>
auto determinant(const Step& a, const Step& b, const Step& c, const Step& d) noexcept {
  return a.in<Number>() * d.in<Number>() - b.in<Number>() * c.in<Number>();
}

/// Sign of (u × v) · w, where doubles do not know it.
[[nodiscard]] int exact_sign(const Step (&u)[3], const Step (&v)[3], const Step (&w)[3]) noexcept;
/// Sign of a · d − b · c, where doubles do not know it.
[[nodiscard]] int exact_sign(const Step& a, const Step& b, const Step& c, const Step& d) noexcept;
/// a · d − b · c, rounded from the exact value a few times.
[[nodiscard]] double exact_determinant(const Step& a, const Step& b, const Step& c, const Step& d) noexcept;

/// Sign of a · d − b · c.
[[nodiscard]] inline int determinant_sign(const Step& a, const Step& b, const Step& c, const Step& d) noexcept {
  constexpr double unit = 0x1p-53;
  const double left = a.rounded() * d.rounded();
  const double right = b.rounded() * c.rounded();
  const double difference = left - right;
  if (std::fabs(difference) > 8 * unit * (std::fabs(left) + std::fabs(right))) return difference > 0 ? 1 : -1;
  if (left == 0 && right == 0) return 0;  // no product of two differences underflows
  return exact_sign(a, b, c, d);
}

/// Whether three points are on one line.
[[nodiscard]] inline bool are_on_one_line(const Vec3& p, const Vec3& q, const Vec3& r) noexcept {
  for (unsigned i = 0; i != 3; ++i) {
    const unsigned j = (i + 1) % 3;
    if (determinant_sign({q[i], p[i]}, {q[j], p[j]}, {r[i], p[i]}, {r[j], p[j]}) != 0) return false;
  }
  return true;
}

/// Whether a difference of two products of differences of floats, each rounded, is off by 2⁻³⁰ of itself at most. The
/// products amount to `size` together, and the difference is off by 8 · 2⁻⁵³ of that. It is exact for products that are
/// 0, as no product of differences underflows.
inline bool is_well_rounded(double difference, double size) noexcept {
  return std::fabs(difference) > 0x1p-19 * size || size == 0;
}

/// a · d − b · c, off by 2⁻³⁰ of itself at most; 0 only if it is 0.
inline double nearly_determinant(const Step& a, const Step& b, const Step& c, const Step& d) noexcept {
  const double left = a.rounded() * d.rounded();
  const double right = b.rounded() * c.rounded();
  const double difference = left - right;
  if (is_well_rounded(difference, std::fabs(left) + std::fabs(right))) return difference;
  return exact_determinant(a, b, c, d);
}

/// The plane through a point, along two vectors u and v: side(x) is the sign of (u × v) · (x − point).
class SpannedPlane {
 public:
  SpannedPlane(const double (&point)[3], const Step (&u)[3], const Step (&v)[3]) noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      point_[k] = point[k];
      u_[k] = u[k];
      v_[k] = v[k];
    }
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned i = (k + 1) % 3;
      const unsigned j = (k + 2) % 3;
      const double left = u_[i].rounded() * v_[j].rounded();
      const double right = u_[j].rounded() * v_[i].rounded();
      rounded_normal_[k] = left - right;
      magnitude_[k] = std::fabs(left) + std::fabs(right);
    }
  }

  [[nodiscard]] int side(const double (&x)[3]) const noexcept {
    return sign_along({{x[0], point_[0]}, {x[1], point_[1]}, {x[2], point_[2]}});
  }

  /// side(), or 0 if doubles do not know it.
  [[nodiscard]] int certain_side(const double (&x)[3]) const noexcept {
    return sign_along({{x[0], point_[0]}, {x[1], point_[1]}, {x[2], point_[2]}}, [] { return 0; });
  }

  /// Sign of (u × v) · w.
  [[nodiscard]] int sign_along(const Step (&w)[3]) const noexcept {
    return sign_along(w, [&] { return exact_sign(u_, v_, w); });
  }

  /// Sign of (u × v) · w, or unknown() if doubles do not know it.
  template <class Unknown>
  [[nodiscard]] int sign_along(const Step (&w)[3], const Unknown& unknown) const noexcept {
    constexpr double unit = 0x1p-53;
    double sum = 0;
    double magnitude = 0;
    for (unsigned k = 0; k < 3; ++k) {
      sum += rounded_normal_[k] * w[k].rounded();
      magnitude += magnitude_[k] * std::fabs(w[k].rounded());
    }
    // Three rounded differences, two rounded products and three rounded sums a term: < 9 units of its magnitude.
    if (std::fabs(sum) > 16 * unit * magnitude) return sum > 0 ? 1 : -1;
    if (magnitude == 0) return 0;  // no product of three differences underflows
    return unknown();
  }

  /// Component k of u × v, as nearly_determinant().
  [[nodiscard]] double normal(unsigned k) const noexcept {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    return nearly_determinant(u_[i], u_[j], v_[i], v_[j]);
  }

 private:
  double point_[3];
  Step u_[3];
  Step v_[3];
  double rounded_normal_[3];
  double magnitude_[3];  ///< of the terms of each component
};

/// The plane through three points. Its front is where they run counterclockwise.
[[nodiscard]] inline SpannedPlane plane_of(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return SpannedPlane({a[0], a[1], a[2]}, Steps(a, b).of, Steps(a, c).of);
}

/// On which side of a plane a point is: 1 in front, −1 behind, 0 on it. Exact.
[[nodiscard]] inline int side_of(const SpannedPlane& plane, const Vec3& point) noexcept {
  return plane.side({point[0], point[1], point[2]});
}

}  // namespace shaftcull::kernel
