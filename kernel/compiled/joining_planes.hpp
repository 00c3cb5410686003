// SPDX-License-Identifier: MIT
/// Joining planes of a compiled shaft, with their error margin.
#pragma once

#include "compiled/shaft_data.hpp"
#include "formation/join.hpp"
#include "formation/rule.hpp"

namespace shaftcull::kernel {

/// Writes the shaft box and the joining planes of `edges`, which are `planes`, into `out`, whose boxes are there
/// already.
void compile_joining_planes(const JoinedEdges& edges, const JoinedPlanes& planes, ShaftData& out) noexcept;

/// Writes the shaft box and the joining planes of a formed shaft whose planes are pending.
void add_joining_planes(ShaftData& shaft) noexcept;

}  // namespace shaftcull::kernel
