// SPDX-License-Identifier: MIT
/// The random shafts of `shaftcull stats`, and what they meet.
///
/// Both are those of the test harness that the paper describes: a shaft joins two boxes whose corners are uniform in
/// the unit cube, and meets cubes centred on a grid of 21³ points that spans the unit cube.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "shaft_choice.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::cli {

inline constexpr int grid_points = 21;  ///< along each axis

struct RandomShafts {
  std::uint32_t count = 10'000;
  std::uint64_t seed = 12345;
  double box_radius = 0.125;  ///< half extent of the cubes
  std::uint32_t lattice = 0;  ///< corners are multiples of 1 / lattice; 0: anywhere
};

struct BoxPair {
  Box a;
  Box b;
};

/// Both boxes anywhere in the unit cube: the same with every standard library.
[[nodiscard]] BoxPair random_pair(std::mt19937_64& random);

/// The next pair that has a shaft of this kind: light and occluder of a shadow are apart. On the lattice, if there is
/// one.
[[nodiscard]] BoxPair next_pair(const RandomShafts& shafts, const ShaftChoice& choice, std::mt19937_64& random);

/// Shifted by 0.001, so that no centre is on a face of the unit cube; with a lattice on the grid itself.
[[nodiscard]] std::vector<Box> grid_of_cubes(const RandomShafts& shafts);

/// One triangle in each of the cubes, with corners anywhere in it, or where the lattice is nearest.
[[nodiscard]] std::vector<Triangle> triangles_in_cubes(const RandomShafts& shafts);

}  // namespace shaftcull::cli
