// SPDX-License-Identifier: MIT
/// What a box that a shaft is formed from must be.
#pragma once

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Throws InvalidArgument unless `box`, called `name` in messages, is finite with lo ≤ hi.
void require_finite(const Box& box, const char* name);

}  // namespace shaftcull::kernel
