// SPDX-License-Identifier: MIT
/// A shaft as the exact test of triangles reads it: a box that moves, in floats that are off by little.
#pragma once

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// Time runs from 0 to 1. Of a shaft that ends, the centre of its box is at that of box(0) + t · centre_slope, and half
/// its extent is half + t · half_slope. A shaft without end passes t / (1 − t) units of time by t, and centre and
/// extent are (1 − t) times that of box(0) + t times the slopes, (1 − t) times too large: that keeps all of it within
/// reach.
///
/// All but `start` are rounded once, from doubles.
struct TriangleShaft {
  float start[3];  ///< lo faces of box(0): the user's floats
  float half[3];   ///< half the extent of box(0)
  float centre_slope[3];
  float half_slope[3];
  float outward_slope[6];  ///< of the faces, in the order of a BoxView's streams: positive if a face moves outwards
  float extent;            ///< at least the sum, over the axes, of 2 half + |centre_slope| + |half_slope|
  float most;  ///< triangles that, together with their distance, extend less suit floats; negative if none do
  bool is_endless;
};

/// Takes some 30 ns. Not for a hull.
[[nodiscard]] TriangleShaft triangle_shaft(const ShaftData& shaft) noexcept;

/// Times the extent of shaft, triangle and distance: what positions and distances are off by. docs/exactness.md counts
/// the roundings that it pays for.
inline constexpr float triangle_margin = 64 * 0x1p-24F;
/// Added to margins, for halves and products that are denormal; larger for products of three lengths.
inline constexpr float triangle_denormals = 0x1p-120F;
inline constexpr float triangle_normal_denormals = 0x1p-105F;
/// The turn of a projected triangle, a sum of two products of edges, is off by so much of the edges' lengths.
inline constexpr float triangle_turn_error = 5 * 0x1p-24F;
/// Where the product of two edges' lengths is less, the denormals that a turn may be off by count.
inline constexpr float least_triangle_product = 0x1p-100F;
/// The latest time that is tried of a shaft without end, where t = 1 stands for no time at all.
inline constexpr float latest_endless_time = 1 - 0x1p-20F;

}  // namespace shaftcull::kernel
