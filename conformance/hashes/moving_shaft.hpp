// SPDX-License-Identifier: MIT
/// Shafts of moving boxes, of all kinds.
#pragma once

#include <cstddef>

#include "shaftcull/compiled.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull::hashes {

/// The shaft of a moving box, or that between both boxes where light and occluder are not apart.
inline CompiledShaft moving_shaft(int kind, const Box& a, const Box& b, const Vec3& way) {
  bool apart = false;
  for (std::size_t k = 0; k != 3; ++k) apart = apart || a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k];
  if (kind >= 2 && !apart) return compile(a, b);
  return kind == 0                    ? swept(a, way)
         : kind == 1 && way != Vec3{} ? swept_infinite(a, way)
         : kind == 2                  ? shadow(b, a, 1.75F)
         : kind == 3                  ? shadow(b, a)
                                      : compile(a, b);
}

}  // namespace shaftcull::hashes
