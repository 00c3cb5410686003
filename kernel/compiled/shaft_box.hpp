// SPDX-License-Identifier: MIT
/// The shaft box: the smallest box around a shaft.
#pragma once

#include <algorithm>

#include "compiled/shaft_data.hpp"
#include "formation/rule.hpp"

namespace shaftcull::kernel {

/// Position of face `f` of the shaft box: the outer one of a's and b's. Of two zeros, either. Of other kinds the face
/// may lie between two floats, or infinitely far away: then it is the last float within it, so that comparisons of
/// floats with it come out as those with the face itself.
inline float shaft_face(const ShaftData& shaft, unsigned f) noexcept {
  if (shaft.kind != ShaftData::Kind::between) [[unlikely]]
    return shaft.face[f];
  return f < 3 ? std::min(shaft.a[f], shaft.b[f]) : std::max(shaft.a[f], shaft.b[f]);
}

}  // namespace shaftcull::kernel
