// SPDX-License-Identifier: MIT
/// Cases that are the same on every machine.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "shaftcull/bounds.hpp"

namespace shaftcull::hashes {

/// Bounds of a scene of one shaft: two words and a rest.
inline constexpr std::size_t bounds_a_scene = 131;

/// Numbers that do not depend on the compiler: integers, and floats made of them without rounding or in one rounding.
class Numbers {
 public:
  /// SplitMix64 (Steele, Lea and Flood, 2014).
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  int below(int limit) { return static_cast<int>(next() >> 33U) % limit; }
  float grid() { return static_cast<float>(below(9) - 4); }
  float fine() { return static_cast<float>(below(1 << 23) - (1 << 22)) * 0x1p-20F; }
  /// A finite float of any bits.
  float any() {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(next()));
    return std::isfinite(x) ? x : 0.0F;
  }
  /// x, or a float up to two ulps from it.
  float near(float x) {
    const int steps = below(5) - 2;
    for (int i = 0; i != std::abs(steps); ++i) {
      const float next = std::nextafter(x, steps < 0 ? -INFINITY : INFINITY);
      if (std::isfinite(next)) x = next;
    }
    return x;
  }

 private:
  std::uint64_t state_ = 2026;
};

using Number = float (Numbers::*)();

/// A fifth of the scenes are of any floats: their bounds touch by chance only.
inline bool is_wild(std::size_t scene) { return scene % 5 == 4; }

/// Half of the other scenes are on a lattice.
inline Number number_of(std::size_t scene) {
  return is_wild(scene) ? &Numbers::any : scene % 2 == 0 ? &Numbers::grid : &Numbers::fine;
}

inline Box sorted(Vec3 p, Vec3 q) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (p[k] > q[k]) std::swap(p[k], q[k]);
  }
  return {p, q};
}

inline Vec3 point(Numbers& numbers, Number number) {
  Vec3 p{};
  for (float& x : p) x = (numbers.*number)();
  return p;
}

inline Box box(Numbers& numbers, Number number) {
  const Vec3 p = point(numbers, number);
  return sorted(p, point(numbers, number));
}

/// A point on the path of a corner from a to b, or an ulp or two beside it.
inline Vec3 edge_point(Numbers& numbers, const Box& a, const Box& b) {
  const double t = numbers.below(17) / 16.0;
  Vec3 p{};
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = numbers.below(2) == 1;
    const double from = static_cast<double>(hi ? a.hi[k] : a.lo[k]);
    const double to = static_cast<double>(hi ? b.hi[k] : b.lo[k]);
    // Exact in doubles for coordinates from fine() and grid(), so rounded once, with or without fused operations.
    const double on_edge = from + t * (to - from);
    p[k] = numbers.near(static_cast<float>(on_edge));
  }
  return p;
}

/// A box around the moving box half-way from a to b, or an ulp or two beside it; now and then one face is far away.
inline Box around_middle(Numbers& numbers, const Box& a, const Box& b) {
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    // Exact in doubles for coordinates from fine() and grid(), so rounded once; halves of floats do not overflow.
    const auto middle = [&](float from, float to) {
      return numbers.near(static_cast<float>(0.5 * static_cast<double>(from) + 0.5 * static_cast<double>(to)));
    };
    box.lo[k] = numbers.below(4) == 0 ? -3e38F : middle(a.lo[k], b.lo[k]);
    box.hi[k] = numbers.below(4) == 0 ? 3e38F : middle(a.hi[k], b.hi[k]);
  }
  return sorted(box.lo, box.hi);
}

}  // namespace shaftcull::hashes
