// SPDX-License-Identifier: MIT
/// On which side of a plane through vertices of a hull a point is: signs of determinants, exactly.
///
/// J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
/// Computational Geometry 18, 1997. Coordinates are floats, so that doubles decide nearly always, and no product of
/// three differences over- or underflows.
#pragma once

#include <cmath>

#include "exact/expansion.hpp"
#include "exact/measured.hpp"
#include "shaftcull/bounds.hpp"

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

/// a · d − b · c in the arithmetic of `Number`, Measured or Expansion<2>.
template <class Number>
auto determinant(const Step& a, const Step& b, const Step& c, const Step& d) noexcept {
  return a.in<Number>() * d.in<Number>() - b.in<Number>() * c.in<Number>();
}

/// Sign of a · d − b · c.
inline int determinant_sign(const Step& a, const Step& b, const Step& c, const Step& d) noexcept {
  constexpr double unit = 0x1p-53;
  const double left = a.rounded() * d.rounded();
  const double right = b.rounded() * c.rounded();
  const double difference = left - right;
  if (std::fabs(difference) > 8 * unit * (std::fabs(left) + std::fabs(right))) return difference > 0 ? 1 : -1;
  const Measured measured = determinant<Measured>(a, b, c, d);
  if (measured.is_known()) return measured.is_positive() ? 1 : measured.is_negative() ? -1 : 0;
  return determinant<Expansion<2>>(a, b, c, d).sign();
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
  const auto exact = determinant<Expansion<2>>(a, b, c, d);
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) sum += exact[i];  // smallest first
  return sum;
}

/// The plane through a point, along two vectors u and v: side(x) is the sign of (u × v) · (x − point).
class SpannedPlane {
  /// (u × v) · w, likewise in the arithmetic of `Number`.
  template <class Number>
  [[nodiscard]] auto along(const Step (&w)[3]) const noexcept {
    return determinant<Number>(u_[1], u_[2], v_[1], v_[2]) * w[0].in<Number>() +
           determinant<Number>(u_[2], u_[0], v_[2], v_[0]) * w[1].in<Number>() +
           determinant<Number>(u_[0], u_[1], v_[0], v_[1]) * w[2].in<Number>();
  }

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

  /// Sign of (u × v) · w.
  [[nodiscard]] int sign_along(const Step (&w)[3]) const noexcept {
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
    const Measured measured = along<Measured>(w);
    if (measured.is_known()) return measured.is_positive() ? 1 : measured.is_negative() ? -1 : 0;
    return along<Expansion<2>>(w).sign();
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
  return SpannedPlane({a[0], a[1], a[2]}, {{b[0], a[0]}, {b[1], a[1]}, {b[2], a[2]}},
                      {{c[0], a[0]}, {c[1], a[1]}, {c[2], a[2]}});
}

/// On which side of a plane a point is: 1 in front, −1 behind, 0 on it. Exact.
[[nodiscard]] inline int side_of(const SpannedPlane& plane, const Vec3& point) noexcept {
  return plane.side({point[0], point[1], point[2]});
}

}  // namespace shaftcull::kernel
