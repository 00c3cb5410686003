// SPDX-License-Identifier: MIT
/// Planes of a view, for all calls that take a view-projection matrix.
#pragma once

#include <span>

#include "shaftcull/geometry.hpp"

namespace shaftcull::kernel {

/// view_planes(), whose errors name `call`, the one that the user made.
ViewPlanes planes_of_view(const char* call, std::span<const float, 16> matrix, ClipDepth depth);

}  // namespace shaftcull::kernel
