// SPDX-License-Identifier: MIT
/// How much two polygons exchange by radiation, from the integral over both outlines (docs/view-factors.md).
#pragma once

#include "radiation/flat_polygon.hpp"

namespace shaftcull::kernel {

/// The integral of cos θ₁ cos θ₂ / (π r²) over both polygons, each of which is in front of the other, by their outlines
/// (Sparrow 1963): ∮∮ ln r ds₁·ds₂ / 2π. Over the edges of `b` the integral is known; those of `a` are cut into pieces.
/// So `a` is to be the smaller one, or digits are lost. Coordinates are about 1 at most. Polygons that are far from
/// each other lose digits, as the sum nearly cancels.
[[nodiscard]] double exchange_by_outlines(const Polygon& a, const Polygon& b) noexcept;

}  // namespace shaftcull::kernel
