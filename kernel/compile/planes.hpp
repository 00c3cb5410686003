/// Joining planes of a compiled shaft, with their error margin.
#pragma once

#include <span>

#include "shaftcull/compiled.hpp"
#include "shaftcull/shaft.hpp"

namespace shaftcull::kernel {

/// Writes the shaft box and the joining planes of `planes`, in their order, into `out`, whose boxes are there already.
void compile_joining_planes(std::span<const JoiningPlane> planes, CompiledShaft& out) noexcept;

}  // namespace shaftcull::kernel
