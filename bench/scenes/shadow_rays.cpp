// SPDX-License-Identifier: MIT
#include "scenes/shadow_rays.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace shaftcull::bench {
namespace {

/// The lowest `bits` bits of i, in reverse.
std::uint32_t reversed(std::uint32_t i, unsigned bits) {
  std::uint32_t result = 0;
  for (unsigned bit = 0; bit != bits; ++bit) result |= (i >> bit & 1U) << (bits - 1 - bit);
  return result;
}

/// 0 … count − 1 in random order, the same one by every compiler.
std::vector<std::uint32_t> shuffled(std::uint32_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::mt19937 random(4303);
  for (std::uint32_t i = count; i > 1; --i) std::swap(numbers[i - 1], numbers[random() % i]);
  return numbers;
}

}  // namespace

ShadowRays::ShadowRays(unsigned ray_count) : count(ray_count) {
  if (!std::has_single_bit(count)) throw std::invalid_argument("the number of rays must be a power of two");
  const auto bits = static_cast<unsigned>(std::countr_zero(count));
  const auto middle = [this](std::uint32_t i) { return (static_cast<float>(i) + 0.5F) / static_cast<float>(count); };
  // Hammersley's points. A random order deals those of the one patch out among those of the other: with any rule that
  // keeps the last bits, both ends of a ray would be on the same side of their patches.
  const std::vector<std::uint32_t> of_b = shuffled(count);
  for (std::uint32_t i = 0; i != count; ++i) {
    for (std::size_t patch = 0; patch != 2; ++patch) {
      const std::uint32_t number = patch == 0 ? i : of_b[i];
      const float u = middle(number);
      const float v = middle(reversed(number, bits));
      const bool beyond = u + v > 1;
      on_rectangle[patch][0].push_back(u);
      on_rectangle[patch][1].push_back(v);
      on_triangle[patch][0].push_back(beyond ? 1 - u : u);
      on_triangle[patch][1].push_back(beyond ? 1 - v : v);
    }
  }
}

}  // namespace shaftcull::bench
