// SPDX-License-Identifier: MIT
/// View factors: which share of the radiation that one patch sends out another one receives (docs/view-factors.md).
#pragma once

#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The view factor from one flat convex polygon to another with nothing between them, from 0 to 1: the integral of
/// cos θ₁ cos θ₂ / (π r²) over both areas, by the area of the first. The pairs that visibility() calls `clear` have it;
/// for others it is an upper bound.
///
/// A polygon has 3 to 8 corners, counterclockwise as seen from the front, which radiates diffusely. The part of one
/// that is behind the other's plane does not count. Corners that are off their plane a little, as those of turned walls
/// are, do no harm. Polygons may share corners and edges.
///
/// The error is below 10⁻⁸ of the factor, or 10⁻¹¹ where that is more; for most pairs it is 10⁻¹². Bits are the same on
/// every machine, whatever the instruction set. Both factors of a pair are one number by the area of either polygon, so
/// A₁ F₁₂ = A₂ F₂₁ but for one rounding.
///
/// About 15 µs for two squares, and 40 µs if they share an edge, since the integrand is not smooth there; 3 µs for
/// distances of more than 40 radii. Allocates nothing, and is safe from many threads. Coordinates are in any unit.
/// Throws InvalidArgument for another number of corners, for one that is not finite, and if `from` has no area.
///
/// The method: E. M. Sparrow, "A New and Simpler Formulation for Radiative Angle Factors", 1963.
[[nodiscard]] SHAFTCULL_EXPORT double view_factor(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace shaftcull
