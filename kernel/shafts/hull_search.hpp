// SPDX-License-Identifier: MIT
/// Planes of any convex hull, by comparing all vertices with all candidates.
#pragma once

#include "compiled/hull_data.hpp"

namespace shaftcull::kernel {

/// Finds and writes all planes of a hull that has its box: the planes of each three vertices that have nothing beyond,
/// then the lines of each two in each projection. Each plane is written once, by the first vertices that it is found
/// by.
void search_hull_planes(HullData& hull) noexcept;

}  // namespace shaftcull::kernel
