// SPDX-License-Identifier: MIT
/// A plane through three points. Signs come from rounded numbers where these are certain.
#pragma once

#include "exact/turned_box.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// The normal n = (q − p) × (r − p) points to the front.
class PlaneOfPoints {
 public:
  PlaneOfPoints() noexcept = default;
  PlaneOfPoints(const Vec3& p, const Vec3& q, const Vec3& r) noexcept;

  /// The sign of n · (x − p) − tolerance |n|₁.
  [[nodiscard]] int side(const Vec3& x, float tolerance) const noexcept;
  /// Whether a box lies behind for certain.
  [[nodiscard]] bool is_behind(const TurnedBox& box, float tolerance) const noexcept;

 private:
  Vec3 p_{};
  Vec3 q_{};
  Vec3 r_{};
  double normal_[3]{};
  double magnitude_[3]{};  ///< of the terms of each component
};

}  // namespace shaftcull::kernel
