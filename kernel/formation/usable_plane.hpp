// SPDX-License-Identifier: MIT
/// What a plane that is added to a shaft must be.
#pragma once

#include <cstddef>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// What messages call a plane: its index between two pieces of text.
struct PlaneName {
  const char* before;
  std::size_t index;
  const char* after;
};

/// Throws InvalidArgument unless the plane is finite and its normal is not zero.
void require_usable(const Plane& plane, const PlaneName& name);

}  // namespace shaftcull::kernel
