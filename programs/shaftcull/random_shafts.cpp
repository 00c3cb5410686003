// SPDX-License-Identifier: MIT
#include "random_shafts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace shaftcull::cli {
namespace {

/// Uniform in [0, 1), with 24 bits.
float unit_number(std::mt19937_64& random) { return static_cast<float>(random() >> 40) * 0x1p-24F; }

void put_on_lattice(Vec3& point, std::uint32_t lattice) {
  if (lattice == 0) return;
  for (float& x : point) x = static_cast<float>(std::round(x * 1.0 * lattice) / lattice);
}

}  // namespace

BoxPair random_pair(std::mt19937_64& random) {
  BoxPair pair{};
  for (Box* box : {&pair.a, &pair.b}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float p = unit_number(random);
      const float q = unit_number(random);
      box->lo[axis] = std::min(p, q);
      box->hi[axis] = std::max(p, q);
    }
  }
  return pair;
}

BoxPair next_pair(const RandomShafts& shafts, const ShaftChoice& choice, std::mt19937_64& random) {
  for (;;) {
    BoxPair pair = random_pair(random);
    for (Vec3* const corner : {&pair.a.lo, &pair.a.hi, &pair.b.lo, &pair.b.hi}) {
      put_on_lattice(*corner, shafts.lattice);
    }
    if (choice.kind() != ShaftKind::shadow || !touch(pair.a, pair.b)) return pair;
  }
}

std::vector<Box> grid_of_cubes(const RandomShafts& shafts) {
  std::vector<Box> cubes;
  cubes.reserve(grid_points * grid_points * grid_points);
  const double shift = shafts.lattice == 0 ? 0.001 : 0;
  const auto at = [=](int i) { return i / (grid_points - 1.0) + shift; };
  for (int z = 0; z < grid_points; ++z) {
    for (int y = 0; y < grid_points; ++y) {
      for (int x = 0; x < grid_points; ++x) {
        const std::array centre{at(x), at(y), at(z)};
        Box cube{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          cube.lo[axis] = static_cast<float>(centre[axis] - shafts.box_radius);
          cube.hi[axis] = static_cast<float>(centre[axis] + shafts.box_radius);
        }
        cubes.push_back(cube);
      }
    }
  }
  return cubes;
}

std::vector<Triangle> triangles_in_cubes(const RandomShafts& shafts) {
  // Random numbers of their own, so that the shafts are those that boxes meet.
  std::mt19937_64 random(~shafts.seed);
  std::vector<Triangle> triangles;
  for (const Box& cube : grid_of_cubes(shafts)) {
    Triangle triangle{};
    for (Vec3& vertex : triangle.vertex) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double lo = cube.lo[axis];
        vertex[axis] = static_cast<float>(lo + unit_number(random) * (cube.hi[axis] - lo));
      }
      put_on_lattice(vertex, shafts.lattice);
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace shaftcull::cli
