// SPDX-License-Identifier: MIT
/// The planes of a convex hull, from its vertices.
#pragma once

#include "compiled/hull_data.hpp"

namespace shaftcull::kernel {

/// Forms a hull of the vertices that it has: finds its box and all planes, with the margins of floats. Needs the
/// standard floating-point modes.
void form_hull(HullData& hull) noexcept;

}  // namespace shaftcull::kernel
