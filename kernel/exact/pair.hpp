// SPDX-License-Identifier: MIT
/// Exact answers for the shaft between two boxes that was never compiled.
#pragma once

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// Whether the box with the faces of `bound` is outside of the shaft between boxes a and b: six finite faces each.
[[nodiscard]] bool is_outside_between(const float (&a)[6], const float (&b)[6], Contact contact,
                                      const float (&bound)[6]) noexcept;

}  // namespace shaftcull::kernel
