// SPDX-License-Identifier: MIT
/// Random numbers, boxes and spheres that are the same on every machine for the same seed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

#include "shaftcull/bounds.hpp"

namespace shaftcull {

inline constexpr float largest_float = std::numeric_limits<float>::max();

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// One of 0 … sides − 1.
  unsigned below(unsigned sides) { return static_cast<unsigned>((engine_() >> 32U) % sides); }
  bool one_in(unsigned sides) { return below(sides) == 0; }
  float uniform(float low, float high) {
    return low + (high - low) * static_cast<float>(static_cast<double>(engine_() >> 40U) * 0x1p-24);
  }
  /// An integer in [low, high].
  float integer(int low, int high) {
    return static_cast<float>(low + static_cast<int>(below(static_cast<unsigned>(high - low + 1))));
  }
  /// A finite float of any sign and a binary exponent from low (−149: denormals) to high (127: up to 3.4e38).
  float wild(int low = -149, int high = 127) {
    const auto exponent = static_cast<int>(integer(low, high));  // first, whatever the order of arguments
    const float magnitude = std::ldexp(uniform(1.0F, 2.0F), exponent);
    const float finite = std::min(magnitude, largest_float);
    return one_in(2) ? finite : -finite;
  }
  /// `x`, or one of the two finite floats on either side of it.
  float nudge(float x) {
    const unsigned steps = below(5);  // up by none, one or two, or down by one or two
    for (unsigned i = steps < 3 ? steps : steps - 2; i != 0; --i) {
      const float next = std::nextafter(x, steps < 3 ? INFINITY : -INFINITY);
      if (std::isfinite(next)) x = next;
    }
    return x;
  }
  Vec3 vec3(float low, float high) { return {uniform(low, high), uniform(low, high), uniform(low, high)}; }

  /// The box with centre in [low, high]³ and half extents in [small, large]; one extent in ten is 0.
  Box box(float low, float high, float small, float large) {
    Box box{};
    for (std::size_t k = 0; k != 3; ++k) {
      const float centre = uniform(low, high);
      const float half = one_in(10) ? 0.0F : uniform(small, large);
      box.lo[k] = centre - half;
      box.hi[k] = centre + half;
    }
    return box;
  }
  /// A box with integer corners in [low, high].
  Box grid_box(int low, int high) {
    return sorted({integer(low, high), integer(low, high), integer(low, high)},
                  {integer(low, high), integer(low, high), integer(low, high)});
  }
  /// The box between two opposite corners.
  static Box sorted(const Vec3& p, const Vec3& q) {
    Box box{};
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = std::min(p[k], q[k]);
      box.hi[k] = std::max(p[k], q[k]);
    }
    return box;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace shaftcull
