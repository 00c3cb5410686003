/// Joining planes of a compiled shaft, with their error margin.
#pragma once

#include "formation/join.hpp"
#include "formation/rule.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// Writes the shaft box and the joining planes of `edges`, which are `planes`, into `out`, whose boxes are there
/// already.
void compile_joining_planes(const JoinedEdges& edges, const JoinedPlanes& planes, CompiledShaft& out) noexcept;

}  // namespace shaftcull::kernel
