// SPDX-License-Identifier: MIT
/// The boxes around spheres: what the slab form tests first.
#pragma once

#include <cmath>

#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// As BoxesAroundSpheres. Corners are rounded to nearest, which the margin of the sphere's stage allows for; a negative
/// radius makes a box that is outside of everything.
template <class L>
void boxes_around_spheres(const float* const* sphere, std::size_t count, float* const* box) noexcept {
  const auto zero = L::all(0.0F);
  const auto minus_infinity = L::all(-INFINITY);
  const auto box_word = [&](const auto& word, std::size_t at) {
    for (std::size_t lane = 0; lane < word_bits; lane += L::width) {
      auto radius = word.load(sphere[3], at, lane);
      radius = word.choose(lane, L::choose(L::less(radius, zero), minus_infinity, radius), minus_infinity);
      for (unsigned k = 0; k < 3; ++k) {
        const auto centre = word.load(sphere[k], at, lane);
        L::store(box[k] + at + lane, L::subtract(centre, radius));
        L::store(box[k + 3] + at + lane, L::add(centre, radius));
      }
    }
  };
  std::size_t i = 0;
  for (; i + word_bits <= count; i += word_bits) box_word(WholeWord<L>{}, i);
  if (i != count) box_word(PartialWord<L>{static_cast<unsigned>(count - i)}, i);
}

}  // namespace shaftcull::kernel
