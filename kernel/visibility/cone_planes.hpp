// SPDX-License-Identifier: MIT
/// Planes of hulls and of the cones behind them, as lanes read them.
#pragma once

#include "exact/hull_cone.hpp"
#include "exact/near_plane.hpp"
#include "kernels/siblings/siblings.hpp"

namespace shaftcull::kernel {

/// For points with coordinates of at most `coordinate`.
[[nodiscard]] ConePlane plane_in_lanes(const HullCone::Plane& plane, EndPoints counting, float tolerance,
                                       float coordinate) noexcept;
/// A face, without a tolerance.
[[nodiscard]] ConePlane plane_in_lanes(const NearPlane& face, float coordinate) noexcept;

}  // namespace shaftcull::kernel
