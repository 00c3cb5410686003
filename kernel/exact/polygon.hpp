// SPDX-License-Identifier: MIT
/// Exact answers for polygons: whether one hides one end of a shaft from the other.
#pragma once

#include <span>

#include "compiled/shaft_data.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Whether every segment between boxes a and b of the shaft passes through the polygon, as shaftcull/occluded.hpp says.
/// At least three points, all finite.
[[nodiscard]] bool polygon_blocks(const ShaftData& shaft, std::span<const Vec3> polygon) noexcept;

}  // namespace shaftcull::kernel
