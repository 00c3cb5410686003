// SPDX-License-Identifier: MIT
/// The corners of bounds that the slab constraints of a shaft read.
#pragma once

#include <cstddef>

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// What the constraints of a shaft read: a corner of each box.
template <class L>
struct BoxCorners {
  static constexpr bool exactly = true;
  static constexpr bool has_radius = false;
  using Vector = typename L::Vector;
  const float* x[6];

  BoxCorners(const ShaftData& shaft, const float* const* box) noexcept {
    for (unsigned i = 0; i < 6; ++i) x[i] = box[shaft.slab_near[i]];
  }
  template <class Word>
  [[nodiscard]] Vector coordinate(unsigned i, const Word& word, std::size_t at, std::size_t lane) const noexcept {
    return word.load(x[i], at, lane);
  }
};

/// Likewise of boxes around spheres. Later stages test the spheres themselves.
template <class L>
struct BoxedSphereCorners : BoxCorners<L> {
  static constexpr bool exactly = false;
  using BoxCorners<L>::BoxCorners;
};

/// Likewise of spheres that come without boxes around them.
template <class L>
struct SphereCorners {
  static constexpr bool exactly = false;
  static constexpr bool has_radius = true;  // if negative, the sphere is outside
  using Vector = typename L::Vector;
  const float* centre[6];
  const float* radius;
  Vector sign[6];  // of the radius: −0 where a constraint reads the lo corner

  SphereCorners(const ShaftData& shaft, const float* const* sphere) noexcept : radius(sphere[3]) {
    for (unsigned i = 0; i < 6; ++i) {
      centre[i] = sphere[shaft.slab_near[i] % 3];
      sign[i] = L::all(shaft.slab_near[i] < 3 ? -0.0F : 0.0F);
    }
  }
  template <class Word>
  [[nodiscard]] Vector coordinate(unsigned i, const Word& word, std::size_t at, std::size_t lane) const noexcept {
    return L::add(word.load(centre[i], at, lane), L::flip_sign(word.load(radius, at, lane), sign[i]));
  }
};

}  // namespace shaftcull::kernel
