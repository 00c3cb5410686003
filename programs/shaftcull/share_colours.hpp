// SPDX-License-Identifier: MIT
/// Colours for shares from 0 to 1, in pictures and meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace shaftcull::cli {

using Rgb = std::array<double, 3>;
using ColourRamp = std::array<Rgb, 6>;

/// From dark violet over red and orange to pale yellow: the lighter, the more is seen.
inline constexpr ColourRamp ramp_of_seen{
    {{28, 16, 68}, {87, 21, 126}, {158, 47, 101}, {221, 81, 58}, {249, 142, 9}, {252, 255, 164}}};
/// From dark to pale blue: the lighter, the more is undecided.
inline constexpr ColourRamp ramp_of_undecided{
    {{20, 26, 46}, {28, 56, 92}, {36, 92, 134}, {66, 136, 168}, {124, 184, 200}, {212, 240, 240}}};

/// The colour at a place from 0 to 1, each part from 0 to 255.
[[nodiscard]] inline std::array<int, 3> colour_at(const ColourRamp& ramp, double place) {
  const double at = place * static_cast<double>(ramp.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
  const double more = at - static_cast<double>(below);
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    rgb[i] = static_cast<int>(std::lround(ramp[below][i] + more * (ramp[below + 1][i] - ramp[below][i])));
  }
  return rgb;
}

}  // namespace shaftcull::cli
