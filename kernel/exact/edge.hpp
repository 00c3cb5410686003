// SPDX-License-Identifier: MIT
/// The edge between a red and a blue face of the shaft box, as a side test in the plane of the two axes.
#pragma once

#include <cmath>

#include "compiled/moving_faces.hpp"
#include "exact/expansion.hpp"

namespace shaftcull::kernel {

/// The faces of a shaft that are not purple, split by colour.
struct Faces {
  unsigned red[6];
  unsigned blue[6];
  unsigned reds = 0;
  unsigned blues = 0;

  explicit Faces(const MovingFaces& faces) noexcept {
    for (unsigned f = 0; f < 6; ++f) {
      if (faces.is_purple(f)) continue;
      if (faces.is_blue(f)) {
        blue[blues++] = f;
      } else {
        red[reds++] = f;
      }
    }
  }
};

/// A product of two differences of floats, (a − b) · (c − d).
struct ProductOfDifferences {
  double a;
  double b;
  double c;
  double d;

  /// The product in the arithmetic of `Number`, Measured or Expansion<2>.
  template <class Number>
  [[nodiscard]] auto in() const noexcept {
    return Number::difference(a, b) * Number::difference(c, d);
  }

  /// The sign of left − right, exactly. All differences are of finite floats.
  [[nodiscard]] friend int compare(const ProductOfDifferences& left, const ProductOfDifferences& right) noexcept {
    constexpr double unit = 0x1p-53;
    const double rounded_left = (left.a - left.b) * (left.c - left.d);
    const double rounded_right = (right.a - right.b) * (right.c - right.d);
    const double difference = rounded_left - rounded_right;
    // Two rounded differences and a rounded product on each side, one rounded difference of both: < 4 units of each.
    // Products of differences of floats neither over- nor underflow.
    if (std::fabs(difference) > 8 * unit * (std::fabs(rounded_left) + std::fabs(rounded_right)))
      return difference > 0 ? 1 : -1;
    if (rounded_left == rounded_right && left.is_exact() && right.is_exact()) return 0;
    return (left.in<Expansion<2>>() - right.in<Expansion<2>>()).sign();
  }

 private:
  /// Whether the product is computed without rounding: the usual case where a bound touches the plane on a grid.
  [[nodiscard]] bool is_exact() const noexcept {
    const TwoTerms first = two_sum(a, -b);
    const TwoTerms second = two_sum(c, -d);
    return first.error == 0 && second.error == 0 && two_product(first.sum, second.sum).error == 0;
  }
};

/// The joining plane of a red face (axis i) and a blue face (axis j), as the orientation predicate
///   side(x, y) = s · ((y − p_j) · q_i − (x − p_i) · q_j),   p = face at t = 0, q = its slope, s = sign(q_i q_j):
/// positive outside, 0 on the plane. It is |(q_i, q_j)| times the signed distance of (x, y) from the plane.
class Edge {
 public:
  Edge(const MovingFaces& faces, unsigned red, unsigned blue) noexcept
      : red_p_(faces.p[red]),
        red_minuend_(faces.minuend[red]),
        red_subtrahend_(faces.subtrahend[red]),
        blue_p_(faces.p[blue]),
        blue_minuend_(faces.minuend[blue]),
        blue_subtrahend_(faces.subtrahend[blue]) {}

  /// side(x, y) in the arithmetic of `Number`, Measured or Expansion<2>.
  template <class Number>
  [[nodiscard]] auto side_in(double x, double y) const noexcept {
    const auto det = left(y).template in<Number>() - right(x).template in<Number>();
    return orientation() > 0 ? det : -det;
  }

  /// |(q_i, q_j)|², likewise.
  template <class Number>
  [[nodiscard]] auto squared_length_in() const noexcept {
    const auto red = Number::difference(red_minuend_, red_subtrahend_);
    const auto blue = Number::difference(blue_minuend_, blue_subtrahend_);
    return red * red + blue * blue;
  }

  /// Sign of side(x, y), exactly; x is on the red face's axis, y on the blue face's. Both finite.
  [[nodiscard]] int side(double x, double y) const noexcept { return orientation() * compare(left(y), right(x)); }

 private:
  [[nodiscard]] ProductOfDifferences left(double y) const noexcept {
    return {y, blue_p_, red_minuend_, red_subtrahend_};
  }
  [[nodiscard]] ProductOfDifferences right(double x) const noexcept {
    return {x, red_p_, blue_minuend_, blue_subtrahend_};
  }

  [[nodiscard]] int orientation() const noexcept {
    return (red_minuend_ > red_subtrahend_) == (blue_minuend_ > blue_subtrahend_) ? 1 : -1;
  }

  double red_p_;
  double red_minuend_;
  double red_subtrahend_;
  double blue_p_;
  double blue_minuend_;
  double blue_subtrahend_;
};

}  // namespace shaftcull::kernel
