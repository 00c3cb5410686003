// SPDX-License-Identifier: MIT
/// Random bounds for benchmarks, the same on every platform.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "shaftcull/bounds.hpp"

namespace shaftcull::bench {

/// Uniform numbers. std::mt19937 is the same everywhere, std::uniform_real_distribution is not.
class Random {
 public:
  explicit Random(std::uint32_t seed) : generator_(seed) {}

  [[nodiscard]] float uniform(float low, float high) {
    const float unit = static_cast<float>(generator_() >> 8) * 0x1p-24F;  // the bits that a float holds
    return low + unit * (high - low);
  }
  [[nodiscard]] Box box(float least_half, float most_half) {
    Box box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float centre = uniform(-5.0F, 5.0F);
      const float half = uniform(least_half, most_half);
      box.lo[axis] = centre - half;
      box.hi[axis] = centre + half;
    }
    return box;
  }
  [[nodiscard]] Sphere sphere(float least_radius, float most_radius) {
    Sphere sphere{};
    for (float& coordinate : sphere.centre) coordinate = uniform(-5.0F, 5.0F);
    sphere.radius = uniform(least_radius, most_radius);
    return sphere;
  }

  /// 0 … limit − 1.
  [[nodiscard]] unsigned below(unsigned limit) {
    return static_cast<unsigned>(uniform(0.0F, static_cast<float>(limit)));
  }

 private:
  std::mt19937 generator_;
};

}  // namespace shaftcull::bench
