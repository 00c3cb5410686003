// SPDX-License-Identifier: MIT
/// Boxes around whole words of bounds: the nodes of a bounds tree.
#pragma once

#include <cmath>

#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// As NodeBounds in kernels/kernel_table.hpp, for boxes: smallest lo, largest hi.
template <class L>
std::uint64_t node_bounds_of_boxes(const float* const* stream, std::size_t words, float* const* node) noexcept {
  std::uint64_t gaps = 0;
  for (std::size_t w = 0; w < words; ++w) {
    const std::size_t at = w * word_bits;
    typename L::Vector lo[3];
    typename L::Vector hi[3];
    for (unsigned k = 0; k < 3; ++k) {
      lo[k] = L::load(stream[k] + at);
      hi[k] = L::load(stream[k + 3] + at);
    }
    auto empty = L::less(hi[0], lo[0]);
    for (unsigned i = L::width; i < word_bits; i += L::width) {
      for (unsigned k = 0; k < 3; ++k) {
        const auto low = L::load(stream[k] + at + i);
        const auto high = L::load(stream[k + 3] + at + i);
        if (k == 0) empty = L::either(empty, L::less(high, low));
        lo[k] = L::minimum(low, lo[k]);
        hi[k] = L::maximum(high, hi[k]);
      }
    }
    if (L::bits(empty) != 0) gaps |= std::uint64_t{1} << w;
    for (unsigned k = 0; k < 3; ++k) {
      node[k][w] = L::smallest(lo[k]);
      node[k + 3][w] = L::largest(hi[k]);
    }
  }
  return gaps;
}

/// At least a unit in the last place of x, of denormals too.
template <class L>
float rounding_of(float x) noexcept {
  return fabsf(x) * 0x1p-23F + 0x1p-149F;
}

/// As NodeBounds in kernels/kernel_table.hpp, for spheres: centre ∓ radius, rounded outwards. That is done once a word:
/// what is subtracted grows more slowly than what it is subtracted from, so the smallest stays the smallest. Padding (a
/// negative radius) is left out.
template <class L>
std::uint64_t node_bounds_of_spheres(const float* const* stream, std::size_t words, float* const* node) noexcept {
  const auto zero = L::all(0.0F);
  const auto minus_infinity = L::all(-INFINITY);
  std::uint64_t gaps = 0;
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t absent = 0;
    typename L::Vector lo[3];
    typename L::Vector hi[3];
    for (unsigned k = 0; k < 3; ++k) {
      lo[k] = L::all(INFINITY);
      hi[k] = minus_infinity;
    }
    for (unsigned i = 0; i < word_bits; i += L::width) {
      const std::size_t at = w * word_bits + i;
      auto radius = L::load(stream[3] + at);
      const auto negative = L::less(radius, zero);
      absent |= L::bits(negative);
      radius = L::choose(negative, minus_infinity, radius);  // its box is empty
      for (unsigned k = 0; k < 3; ++k) {
        const auto centre = L::load(stream[k] + at);
        lo[k] = L::minimum(L::subtract(centre, radius), lo[k]);
        hi[k] = L::maximum(L::add(centre, radius), hi[k]);
      }
    }
    if (absent != 0) gaps |= std::uint64_t{1} << w;
    for (unsigned k = 0; k < 3; ++k) {
      const float low = L::smallest(lo[k]);
      const float high = L::largest(hi[k]);
      node[k][w] = low - rounding_of<L>(low);
      node[k + 3][w] = high + rounding_of<L>(high);
    }
  }
  return gaps;
}

}  // namespace shaftcull::kernel
