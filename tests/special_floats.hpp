// SPDX-License-Identifier: MIT
/// Floats that are no finite number.
#pragma once

#include <limits>

namespace shaftcull {

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();

}  // namespace shaftcull
