// SPDX-License-Identifier: MIT
/// How much two polygons exchange by radiation (docs/view-factors.md).
#pragma once

#include "radiation/flat_polygon.hpp"

namespace shaftcull::kernel {

/// The integral of cos θ₁ cos θ₂ / (π r²) over both polygons, each of which is in front of the other: their view
/// factors, times the area of the one that radiates. The order of the two does not matter to the bit, if scaled alike.
/// Coordinates are about 1 at most.
[[nodiscard]] double exchange_area(const Polygon& a, const Polygon& b) noexcept;

}  // namespace shaftcull::kernel
