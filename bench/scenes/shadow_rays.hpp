// SPDX-License-Identifier: MIT
/// Between which points of two patches shadow rays run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shaftcull::bench {

/// Rays do not look at this share of their length at either end, where the surfaces are that they begin and end on.
inline constexpr float ray_margin = 1e-4F;

/// `count` rays, a power of two, from a point of patch a to one of patch b, the same for all pairs. Points of each
/// patch are a (0, m, 2)-net in base 2: of all ways to cut the patch into count equal boxes by halving, each box has
/// one.
struct ShadowRays {
  /// u and v of a patch's points; inside of a triangle those of `on_triangle`.
  using Points = std::array<std::vector<float>, 2>;

  explicit ShadowRays(unsigned ray_count);

  unsigned count;
  std::array<Points, 2> on_rectangle;  ///< of patch a, and of patch b
  std::array<Points, 2> on_triangle;
};

}  // namespace shaftcull::bench
