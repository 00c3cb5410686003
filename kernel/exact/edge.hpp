// SPDX-License-Identifier: MIT
/// The edge between a red and a blue face of the shaft box, as a side test in the plane of the two axes.
#pragma once

#include "compiled/moving_faces.hpp"
#include "exact/orientation.hpp"

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
        blue_p_(faces.p[blue]),
        red_slope_{faces.minuend[red], faces.subtrahend[red]},
        blue_slope_{faces.minuend[blue], faces.subtrahend[blue]} {}

  /// side(x, y) in the arithmetic of `Number`, Measured or Expansion<2>.
  template <class Number>
  [[nodiscard]] auto side_in(double x, double y) const noexcept {
    const auto det = determinant<Number>({y, blue_p_}, {x, red_p_}, blue_slope_, red_slope_);
    return orientation() > 0 ? det : -det;
  }

  /// |(q_i, q_j)|², likewise.
  template <class Number>
  [[nodiscard]] auto squared_length_in() const noexcept {
    const auto red = red_slope_.in<Number>();
    const auto blue = blue_slope_.in<Number>();
    return red * red + blue * blue;
  }

  /// Sign of side(x, y), exactly; x is on the red face's axis, y on the blue face's. Both finite.
  [[nodiscard]] int side(double x, double y) const noexcept {
    return orientation() * determinant_sign({y, blue_p_}, {x, red_p_}, blue_slope_, red_slope_);
  }

 private:
  [[nodiscard]] int orientation() const noexcept {
    return (red_slope_.end > red_slope_.start) == (blue_slope_.end > blue_slope_.start) ? 1 : -1;
  }

  double red_p_;
  double blue_p_;
  Step red_slope_;
  Step blue_slope_;
};

}  // namespace shaftcull::kernel
