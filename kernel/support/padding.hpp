// SPDX-License-Identifier: MIT
/// Padding: what stands behind the last bound up to a whole word of 64, so that kernels may test whole vectors.
#pragma once

#include <cmath>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Padding is empty bounds: they are outside of every shaft, and floats alone decide so, without an exact step. In the
/// order of the streams of BoxView, SphereView and TriangleView. Arrays, because kernels call no function of the
/// standard library.
inline constexpr float padding_box[6] = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
inline constexpr float padding_sphere[4] = {0, 0, 0, -1};
inline constexpr float padding_triangle[9] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};

inline constexpr Box empty_box{{padding_box[0], padding_box[1], padding_box[2]},
                               {padding_box[3], padding_box[4], padding_box[5]}};

}  // namespace shaftcull::kernel
