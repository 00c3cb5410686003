// SPDX-License-Identifier: MIT
/// Boxes as kernels for what sees what read them.
#pragma once

#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull {

[[nodiscard]] inline kernel::BoxRow row_of(const Box& box) {
  return {{box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2], 0, 0}};
}

}  // namespace shaftcull
