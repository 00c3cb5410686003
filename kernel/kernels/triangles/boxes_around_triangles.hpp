// SPDX-License-Identifier: MIT
/// The boxes around triangles: what the slab form tests first.
#pragma once

#include <cmath>

#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// Writes the boxes around `count` triangles, at most `most`, in nine streams, to six; whole vectors of the last ones.
/// Coordinates that are NaN are left out. Where an axis has no other, the box is an empty one there, lo = +∞ and hi =
/// −∞.
template <class L, std::size_t most>
void boxes_around_triangles(const float* const* triangle, std::size_t count, float (&box)[6][most]) noexcept {
  const float* x[9];  // in registers, which the caller's are not while boxes are written
  for (unsigned s = 0; s < 9; ++s) x[s] = triangle[s];
  // Minimum and maximum pass over a NaN in their first operand.
  const auto infinity = L::all(INFINITY);
  const auto minus_infinity = L::all(-INFINITY);
  const auto box_word = [&](const auto& word, std::size_t at) {
    for (std::size_t lane = 0; lane < word.bounds; lane += L::width) {
      for (unsigned k = 0; k < 3; ++k) {
        const auto x0 = word.load(x[k], at, lane);
        const auto x1 = word.load(x[k + 3], at, lane);
        const auto x2 = word.load(x[k + 6], at, lane);
        L::store(&box[k][at + lane], L::minimum(x0, L::minimum(x1, L::minimum(x2, infinity))));
        L::store(&box[k + 3][at + lane], L::maximum(x0, L::maximum(x1, L::maximum(x2, minus_infinity))));
      }
    }
  };
  std::size_t i = 0;
  for (; i + word_bits <= count; i += word_bits) box_word(WholeWord<L>{}, i);
  if (i != count) box_word(PartialWord<L>{static_cast<unsigned>(count - i)}, i);
}

}  // namespace shaftcull::kernel
