/// Boxes around whole words of bounds: the nodes of a bounds tree.
#pragma once

#include "simd/float_environment.hpp"
#include "test/word.hpp"

namespace shaftcull::kernel {

/// Smallest and largest of the 64 floats from `x` on.
template <class L>
float smallest_of_word(const float* x) noexcept {
  auto least = L::load(x);
  for (unsigned i = L::width; i < word_bits; i += L::width) least = L::minimum(L::load(x + i), least);
  float lane[L::width];
  L::store(lane, least);
  for (unsigned half = L::width / 2; half != 0; half /= 2) {
    for (unsigned i = 0; i < half; ++i) lane[i] = lane[i + half] < lane[i] ? lane[i + half] : lane[i];
  }
  return lane[0];
}
template <class L>
float largest_of_word(const float* x) noexcept {
  auto most = L::load(x);
  for (unsigned i = L::width; i < word_bits; i += L::width) most = L::maximum(L::load(x + i), most);
  float lane[L::width];
  L::store(lane, most);
  for (unsigned half = L::width / 2; half != 0; half /= 2) {
    for (unsigned i = 0; i < half; ++i) lane[i] = lane[i] < lane[i + half] ? lane[i + half] : lane[i];
  }
  return lane[0];
}

/// As Unite in kernels.hpp, for boxes: smallest lo, largest hi.
template <class L>
std::uint64_t unite_boxes(const float* const* stream, std::size_t words, float* const* node) noexcept {
  const FloatEnvironment<L> environment;
  std::uint64_t gaps = 0;
  for (std::size_t w = 0; w < words; ++w) {
    const std::size_t at = w * word_bits;
    auto empty = L::less(L::load(stream[3] + at), L::load(stream[0] + at));
    for (unsigned i = L::width; i < word_bits; i += L::width) {
      empty = L::either(empty, L::less(L::load(stream[3] + at + i), L::load(stream[0] + at + i)));
    }
    if (L::bits(empty) != 0) gaps |= std::uint64_t{1} << w;
    for (unsigned k = 0; k < 3; ++k) node[k][w] = smallest_of_word<L>(stream[k] + at);
    for (unsigned k = 3; k < 6; ++k) node[k][w] = largest_of_word<L>(stream[k] + at);
  }
  return gaps;
}

/// As Unite in kernels.hpp, for spheres: centre ∓ radius, rounded outwards by at least a unit in the last place. Padding
/// (a negative radius) becomes an empty box on the way.
template <class L>
std::uint64_t unite_spheres(const float* const* stream, std::size_t words, float* const* node) noexcept {
  const FloatEnvironment<L> environment;
  const auto zero = L::all(0.0F);
  const auto infinity = L::all(__builtin_inff());
  const auto unit = L::all(0x1p-23F);  // at least a unit in the last place of x, if multiplied by |x|; plus that of denormals
  const auto least_unit = L::all(0x1p-149F);
  std::uint64_t gaps = 0;
  for (std::size_t w = 0; w < words; ++w) {
    float corner[6][word_bits];
    std::uint64_t empty = 0;
    for (unsigned i = 0; i < word_bits; i += L::width) {
      const std::size_t at = w * word_bits + i;
      const auto radius = L::load(stream[3] + at);
      const auto absent = L::less(radius, zero);
      empty |= L::bits(absent);
      for (unsigned k = 0; k < 3; ++k) {
        const auto centre = L::load(stream[k] + at);
        const auto lo = L::subtract(centre, radius);
        const auto hi = L::add(centre, radius);
        const auto lo_error = L::multiply_add(L::magnitude(lo), unit, least_unit);
        const auto hi_error = L::multiply_add(L::magnitude(hi), unit, least_unit);
        L::store(corner[k] + i, L::choose(absent, infinity, L::subtract(lo, lo_error)));
        L::store(corner[k + 3] + i, L::choose(absent, L::subtract(zero, infinity), L::add(hi, hi_error)));
      }
    }
    if (empty != 0) gaps |= std::uint64_t{1} << w;
    for (unsigned k = 0; k < 3; ++k) {
      node[k][w] = smallest_of_word<L>(corner[k]);
      node[k + 3][w] = largest_of_word<L>(corner[k + 3]);
    }
  }
  return gaps;
}

}  // namespace shaftcull::kernel
