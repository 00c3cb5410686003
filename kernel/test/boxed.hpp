/// The boxes around spheres: what the slab form tests first.
#pragma once

#include "simd/float_environment.hpp"
#include "test/word.hpp"

namespace shaftcull::kernel {

/// Writes the boxes around `count` spheres, a multiple of the vector width. Corners are rounded to nearest, which the margin of
/// the sphere's stage allows for; a negative radius makes a box that is outside of everything.
template <class L>
void box_spheres(const float* const* sphere, std::size_t count, float* const* box) noexcept {
  const FloatEnvironment<L> environment;
  const auto zero = L::all(0.0F);
  const auto infinite = L::all(__builtin_inff());
  for (std::size_t i = 0; i < count; i += L::width) {
    auto radius = L::load(sphere[3] + i);
    radius = L::choose(L::less(radius, zero), L::subtract(zero, infinite), radius);
    for (unsigned k = 0; k < 3; ++k) {
      const auto centre = L::load(sphere[k] + i);
      L::store(box[k] + i, L::subtract(centre, radius));
      L::store(box[k + 3] + i, L::add(centre, radius));
    }
  }
}

}  // namespace shaftcull::kernel
