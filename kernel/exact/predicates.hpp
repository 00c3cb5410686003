/// Exact answers for single bounds: what the kernels ask about the lanes that their float arithmetic cannot decide.
///
/// Every predicate starts again from the floats that the user gave (MovingFaces), never from compiled coefficients, and
/// returns the answer of real arithmetic. Coordinates of the bound that are infinite or NaN put no constraint on it
/// unless they are beyond a face of the shaft box.
#pragma once

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// The slab form's question for many boxes of one shaft: is the largest lower bound on t above the smallest upper one?
/// Construction costs about as much as one answer. Opposite faces count as a pair like any other, which changes
/// nothing for boxes with lo ≤ hi.
class SlabPredicate {
 public:
  explicit SlabPredicate(const ShaftData& shaft) noexcept;

  /// Whether the box with the corners of `bound` (order of a BoxView's streams) is outside the shaft; added planes are
  /// left out.
  [[nodiscard]] bool outside(const float (&bound)[6]) const noexcept;

 private:
  struct Constraint {
    unsigned face;
    unsigned near;   // stream of the bound that it reads
    double p;        // the face at t = 0
    double inverse;  // 1 / its slope
  };
  MovingFaces faces_;
  bool is_endless_;
  double end_;
  float face_[6];
  Constraint upper_[6];
  Constraint lower_[6];
  unsigned uppers_ = 0;
  unsigned lowers_ = 0;
};

/// Whether the box with the corners of `bound` is outside the shaft, by its joining planes and box, or any added plane.
[[nodiscard]] bool box_outside(const ShaftData& shaft, const float (&bound)[6]) noexcept;

/// Whether that box is inside the shaft and all added planes.
[[nodiscard]] bool box_inside(const ShaftData& shaft, const float (&bound)[6]) noexcept;

/// Whether the sphere (centre x, y, z, radius) is outside the shaft or any added plane: farther than its radius.
[[nodiscard]] bool sphere_outside(const ShaftData& shaft, const float (&sphere)[4]) noexcept;

/// Whether the sphere is inside the shaft and all added planes: every face at least its radius away.
[[nodiscard]] bool sphere_inside(const ShaftData& shaft, const float (&sphere)[4]) noexcept;

}  // namespace shaftcull::kernel
