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
    const auto det = Number::difference(y, blue_p_) * Number::difference(red_minuend_, red_subtrahend_) -
                     Number::difference(x, red_p_) * Number::difference(blue_minuend_, blue_subtrahend_);
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
  [[nodiscard]] int side(double x, double y) const noexcept {
    constexpr double unit = 0x1p-53;
    const double left = (y - blue_p_) * (red_minuend_ - red_subtrahend_);
    const double right = (x - red_p_) * (blue_minuend_ - blue_subtrahend_);
    const double det = left - right;
    // Two rounded differences and a rounded product on each side, one rounded difference of both: < 4 units of each.
    // Products of differences of floats neither over- nor underflow.
    if (std::fabs(det) > 8 * unit * (std::fabs(left) + std::fabs(right)))
      return det > 0 ? orientation() : -orientation();
    if (left == right && exact_product(y, blue_p_, red_minuend_, red_subtrahend_) &&
        exact_product(x, red_p_, blue_minuend_, blue_subtrahend_))
      return 0;
    return side_in<Expansion<2>>(x, y).sign();
  }

 private:
  /// Whether (a − b) · (c − d) is computed without rounding: the usual case where a bound touches the plane on a grid.
  [[nodiscard]] static bool exact_product(double a, double b, double c, double d) noexcept {
    const TwoTerms first = two_sum(a, -b);
    const TwoTerms second = two_sum(c, -d);
    return first.error == 0 && second.error == 0 && two_product(first.sum, second.sum).error == 0;
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
