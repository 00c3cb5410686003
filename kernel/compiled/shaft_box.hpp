/// The shaft box: the smallest box around a shaft's two boxes.
#pragma once

#include <algorithm>

#include "compiled/shaft_data.hpp"
#include "formation/rule.hpp"

namespace shaftcull::kernel {

/// Position of face `f` of the shaft box: the outer one of a's and b's. Of two zeros, either.
inline float shaft_face(const ShaftData& shaft, unsigned f) noexcept {
  return f < 3 ? std::min(shaft.a[f], shaft.b[f]) : std::max(shaft.a[f], shaft.b[f]);
}

}  // namespace shaftcull::kernel
