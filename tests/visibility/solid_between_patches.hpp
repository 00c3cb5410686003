// SPDX-License-Identifier: MIT
/// Random solids between a patch and others, many of them flush.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/siblings/siblings.hpp"
#include "oracle/random.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull {

/// A solid, a patch on one side of it or on it, and 64 others on the other side or on it.
struct SolidBetweenPatches {
  Random random;
  float factor = 1;
  float offset = 0;
  float tolerance = 0;
  std::vector<Vec3> solid;
  std::vector<Vec3> fixed;
  std::vector<std::vector<Vec3>> others;

  SolidBetweenPatches(std::uint64_t seed, std::size_t solid_points, int thinnest) : random(seed) {
    constexpr float factors[] = {1, 0.37F, 0x1p-20F, 1e6F, 0x1p-100F, 0x1p60F};
    factor = factors[random.below(6)];
    offset = random.one_in(4) ? 1e3F : 0;
    if (random.one_in(2)) tolerance = std::ldexp(64 * factor, -6 - static_cast<int>(random.below(14)));
    for (std::size_t i = 0; i != solid_points; ++i) solid.push_back(point(0, 3 + thinnest, 6));
    fixed = patch(-10);
    while (others.size() != kernel::most_siblings) others.push_back(patch(10));
  }
  [[nodiscard]] Vec3 point(int x, int reach_of_x, int reach) {
    Vec3 at{};
    for (std::size_t k = 0; k != 3; ++k) {
      const float middle = k == 0 ? static_cast<float>(x) : 0;
      const int most = k == 0 ? reach_of_x : reach;
      at[k] = (middle + random.integer(-most, most) + offset) * factor;
      if (random.one_in(8)) at[k] = random.nudge(at[k]);
    }
    return at;
  }
  /// A small triangle, or one between corners of the solid.
  [[nodiscard]] std::vector<Vec3> patch(int x) {
    std::vector<Vec3> corners;
    if (random.one_in(4)) {
      const auto corner = [&] { return solid[random.below(static_cast<unsigned>(solid.size()))]; };
      for (int c = 0; c != 3; ++c) corners.push_back(corner());
      return corners;
    }
    const Vec3 at = point(x, 2, 3);
    for (int c = 0; c != 3; ++c) {
      Vec3 corner = at;
      for (std::size_t k = 0; k != 3; ++k) corner[k] += random.integer(-1, 1) * factor;
      corners.push_back(corner);
    }
    return corners;
  }
  [[nodiscard]] float coordinate() const { return (offset + 64) * factor; }
};

}  // namespace shaftcull
