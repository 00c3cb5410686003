// SPDX-License-Identifier: MIT
/// Exact answers for single boxes: what kernels ask about a box of which floats cannot tell whether it blocks a shaft.
#pragma once

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// Whether the box with the corners of `bound` (order of a BoxView's streams) blocks every segment between boxes a and
/// b of the shaft, as shaftcull/occluded.hpp says. It starts again from the floats that the user gave. A box that is
/// empty or has a NaN blocks nothing; an infinite one is an unbounded box.
[[nodiscard]] bool box_blocks(const ShaftData& shaft, const float (&bound)[6]) noexcept;

}  // namespace shaftcull::kernel
