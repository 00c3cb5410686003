// SPDX-License-Identifier: MIT
/// Bounds of a solid that segments are compared with in lanes.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/siblings/siblings.hpp"

namespace shaftcull::kernel {

/// A box around a solid, and a ball around the middle of the box, in a scene with coordinates of at most `coordinate`.
[[nodiscard]] inline SolidBounds solid_bounds(const BoxRow& around, double radius, float coordinate) noexcept {
  constexpr double more = 1 + 0x1p-18;
  SolidBounds bounds{};
  bounds.is_bounded = coordinate < 0x1p28F;
  bounds.has_interior = true;
  double off = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double lo = around.face[k];
    const double hi = around.face[k + 3];
    bounds.has_interior = bounds.has_interior && lo < hi;
    bounds.lo[k] = around.face[k];
    bounds.hi[k] = around.face[k + 3];
    bounds.middle[k] = static_cast<float>((lo + hi) / 2);
    const double middle = bounds.middle[k];
    bounds.half[k] = static_cast<float>(more * std::max(hi - middle, middle - lo));
    off += std::fabs((lo + hi) / 2 - middle);
  }
  bounds.radius = static_cast<float>(more * (radius + off));
  return bounds;
}

}  // namespace shaftcull::kernel
