// SPDX-License-Identifier: MIT
/// Added planes: the value of n · p − d.
#pragma once

#include <cmath>

#include "compiled/shaft_data.hpp"
#include "exact/expansion.hpp"

namespace shaftcull::kernel {

/// n · p − d of added plane `i` in the arithmetic of `Number`, Measured or Expansion<7>; axes with a zero normal
/// component or a coordinate that is not finite are left out.
template <class Number>
Number added_side(const ShaftData& shaft, unsigned i, const double (&point)[3]) noexcept {
  Number sum(shaft.added[i].minus_offset);
  for (unsigned k = 0; k < 3; ++k) {
    const double n = shaft.added[i].normal[k];
    if (n != 0 && std::isfinite(point[k])) sum.grow(n * point[k]);  // two 24-bit factors: exact in a double
  }
  return sum;
}

/// The squared length of the normal, likewise; Measured or Expansion<3>.
template <class Number>
Number added_squared_length(const ShaftData& shaft, unsigned i) noexcept {
  Number sum;
  for (const float n : shaft.added[i].normal) sum.grow(static_cast<double>(n) * n);
  return sum;
}

}  // namespace shaftcull::kernel
