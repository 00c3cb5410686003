// SPDX-License-Identifier: MIT
/// Exact answers for single bounds: what the kernels ask about the lanes that their float arithmetic cannot decide.
///
/// Every predicate starts again from the floats that the user gave (MovingFaces), never from compiled coefficients, and
/// returns the answer of real arithmetic. Coordinates of the bound that are infinite or NaN put no constraint on it
/// unless they are beyond a face of the shaft box. What is outside follows the shaft's contact: with Contact::open what
/// only touches is (exact/open_contact.hpp). Inside does not.
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
  SlabPredicate(const ShaftData& shaft, Contact contact) noexcept;

  /// Whether the box with the corners of `bound` (order of a BoxView's streams) is outside the shaft; added planes are
  /// left out.
  [[nodiscard]] bool outside(const float (&bound)[6]) const noexcept;

 private:
  template <Contact contact>
  [[nodiscard]] bool outside_by(const float (&bound)[6]) const noexcept;

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
  Contact contact_;
  unsigned flat_axes_ = 0;  // with open contact
  const ShaftData& shaft_;
};

/// Whether the box with the corners of `bound` is outside the shaft, by its joining planes and box, or any added plane.
[[nodiscard]] bool box_outside(const ShaftData& shaft, const float (&bound)[6]) noexcept;

/// Whether a box is outside of the shaft between boxes a and b, which was never compiled: six finite faces each.
[[nodiscard]] bool is_outside_between(const float (&a)[6], const float (&b)[6], Contact contact,
                                      const float (&bound)[6]) noexcept;

/// Whether the box with the corners of `bound` is inside the shaft and all added planes.
[[nodiscard]] bool box_inside(const ShaftData& shaft, const float (&bound)[6]) noexcept;

/// Likewise, and touches none of their planes. It may say no of a box that touches none.
[[nodiscard]] bool box_strictly_inside(const ShaftData& shaft, const float (&bound)[6]) noexcept;

/// Whether the sphere (centre x, y, z, radius) is outside the shaft or any added plane: farther than its radius.
[[nodiscard]] bool sphere_outside(const ShaftData& shaft, const float (&sphere)[4]) noexcept;

/// Whether the sphere is inside the shaft and all added planes: every face at least its radius away.
[[nodiscard]] bool sphere_inside(const ShaftData& shaft, const float (&sphere)[4]) noexcept;

}  // namespace shaftcull::kernel
