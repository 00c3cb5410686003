// SPDX-License-Identifier: MIT
/// The plane through three points with its normal in doubles: signs of most points are certain without a determinant.
#pragma once

#include <array>
#include <cmath>

#include "exact/orientation.hpp"
#include "exact/patch_plane.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Its front is where the points run counterclockwise. They are not on one line.
class NearPlane {
 public:
  NearPlane(const Vec3& p, const Vec3& q, const Vec3& r) noexcept : points_{p, q, r} {
    const SpannedPlane plane = plane_of(p, q, r);
    unsigned aslant = 0;
    for (unsigned k = 0; k != 3; ++k) {
      normal_[k] = plane.normal(k);
      aslant += normal_[k] != 0 ? 1 : 0;
    }
    is_across_axis_ = aslant == 1;
    length_ = std::fabs(normal_[0]) + std::fabs(normal_[1]) + std::fabs(normal_[2]);
  }

  [[nodiscard]] const std::array<Vec3, 3>& points() const noexcept { return points_; }
  /// Component k of the normal, off by 2⁻²⁸ of itself at most.
  [[nodiscard]] double normal(unsigned k) const noexcept { return normal_[k]; }

  /// On which side a point is: 1 in front, −1 behind, 0 on it. Exact.
  [[nodiscard]] int side(const Vec3& x) const noexcept {
    const Height height = height_of(x);
    // Across an axis the sign is that of a difference of two coordinates.
    if (is_across_axis_ || std::fabs(height.value) > margin * height.magnitude) {
      return height.value > 0 ? 1 : height.value < 0 ? -1 : 0;
    }
    return side_of(plane_of(points_[0], points_[1], points_[2]), x);
  }

  /// Whether a point stays behind if each of its coordinates moves by the tolerance. Exact.
  [[nodiscard]] bool is_behind(const Vec3& x, float tolerance) const noexcept {
    if (tolerance == 0) return side(x) < 0;
    Height height = height_of(x);
    const double allowed = tolerance * length_;
    height.value += allowed;
    if (std::fabs(height.value) > margin * (height.magnitude + allowed)) return height.value < 0;
    return height_sign(points_[0], points_[2], points_[1], x, tolerance) > 0;
  }

 private:
  /// Above the error of the normal, and of a few roundings.
  static constexpr double margin = 0x1p-27;

  struct Height {
    double value;
    double magnitude;
  };
  [[nodiscard]] Height height_of(const Vec3& x) const noexcept {
    Height height{0, 0};
    for (unsigned k = 0; k != 3; ++k) {
      const double term = normal_[k] * (double{x[k]} - double{points_[0][k]});
      height.value += term;
      height.magnitude += std::fabs(term);
    }
    return height;
  }

  std::array<Vec3, 3> points_;
  double normal_[3];
  double length_;  ///< of the normal, as the sum of its components
  bool is_across_axis_;
};

}  // namespace shaftcull::kernel
