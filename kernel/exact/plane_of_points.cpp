// SPDX-License-Identifier: MIT
#include "exact/plane_of_points.hpp"

#include <algorithm>
#include <cmath>

#include "exact/patch_plane.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
PlaneOfPoints::PlaneOfPoints(const Vec3& p, const Vec3& q, const Vec3& r) noexcept : p_(p), q_(q), r_(r) {
  for (unsigned k = 0; k != 3; ++k) {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    const double left = (double{q[i]} - p[i]) * (double{r[j]} - p[j]);
    const double right = (double{q[j]} - p[j]) * (double{r[i]} - p[i]);
    normal_[k] = left - right;
    magnitude_[k] = std::fabs(left) + std::fabs(right);
  }
}

int PlaneOfPoints::side(const Vec3& x, float tolerance) const noexcept {
  double sum = 0;
  double magnitude = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double along = double{x[k]} - p_[k];
    sum += normal_[k] * along - double{tolerance} * std::fabs(normal_[k]);
    magnitude += magnitude_[k] * (std::fabs(along) + double{tolerance});
  }
  if (magnitude == 0) return 0;  // no product of three differences underflows
  // As height_sign() has it: a term rounds fewer than 12 times.
  if (std::fabs(sum) > 24 * 0x1p-53 * magnitude) return sum > 0 ? 1 : -1;
  return height_sign(p_, q_, r_, x, tolerance);
}

/// Whether a box lies behind for certain.
bool PlaneOfPoints::is_behind(const TurnedBox& box, float tolerance) const noexcept {
  const Double3 normal{normal_[0], normal_[1], normal_[2]};
  double farthest = box.farthest(normal);
  double size = 0;
  double magnitude = 0;
  for (unsigned k = 0; k != 3; ++k) {
    farthest -= normal_[k] * p_[k] + double{tolerance} * std::fabs(normal_[k]);
    magnitude += magnitude_[k];
    size = std::max(size, std::fabs(double{p_[k]}));
  }
  return farthest < -0x1p-38 * magnitude * (size + box.size + double{tolerance});
}

}  // namespace shaftcull::kernel
