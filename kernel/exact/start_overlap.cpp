// SPDX-License-Identifier: MIT
#include "exact/start_overlap.hpp"

#include <cmath>

#include "exact/wide_integer.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

/// −1, 0 or 1: the sign of the squared distance of a point from a box, minus the square of a radius. Coordinates that
/// are not finite put no constraint on the point.
int exact_side(const float* box, const float (&sphere)[4]) noexcept {
  constexpr int scale = 149;  // 2⁻¹⁴⁹ divides every float
  const WideInteger radius = WideInteger::scaled(sphere[3], scale);
  WideInteger excess = -(radius * radius);
  for (unsigned f = 0; f < 6; ++f) {
    const float c = sphere[f % 3];
    if (!std::isfinite(c) || (f < 3 ? c >= box[f] : c <= box[f])) continue;
    const WideInteger gap = WideInteger::scaled(box[f], scale) - WideInteger::scaled(c, scale);
    excess = excess + gap * gap;
  }
  return excess.sign();
}

}  // namespace

bool StartOverlap::has(const SphereView& /*of*/, const float* const* stream, std::size_t i) const noexcept {
  const float sphere[4] = {stream[0][i], stream[1][i], stream[2][i], stream[3][i]};
  if (!std::isfinite(sphere[3])) return true;
  if (sphere[3] == 0) {  // a point, which is its own relative interior
    for (unsigned k = 0; k < 3; ++k) {
      if (std::isfinite(sphere[k]) && !meets(k, sphere[k], sphere[k])) return false;
    }
    return true;
  }
  // The interior of a ball meets the relative interior of a box iff it meets the box.
  double square = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const double c = sphere[k];
    if (!std::isfinite(c)) continue;
    const double gap = c < start_[k] ? start_[k] - c : c > start_[k + 3] ? c - start_[k + 3] : 0;
    square += gap * gap;
  }
  const double radius_square = static_cast<double>(sphere[3]) * sphere[3];  // exact, as is the sign of what is not 0
  constexpr double margin = 0x1p-48;  // gaps, squares and sums are off by 2⁻⁵³ of themselves each
  if (square < radius_square * (1 - margin)) return true;
  if (square > radius_square * (1 + margin)) return false;
  const int side = exact_side(start_, sphere);
  return side < 0 || (side == 0 && !is_open_);
}

}  // namespace shaftcull::kernel
