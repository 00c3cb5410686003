// SPDX-License-Identifier: MIT
/// Planes that the user adds: the sign at the near and far corner is the exact one.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cull/agreement.hpp"
#include "oracle/cases/bounds.hpp"
#include "oracle/cases/shafts.hpp"
#include "oracle/random.hpp"

namespace shaftcull {
namespace {

ShaftInput shaft_with_planes(Random& random, bool grid) {
  return with_planes(
      random, grid ? grid_shaft(random) : ShaftInput{random.box(-3, 3, 0.2F, 2.0F), random.box(-3, 3, 0.2F, 2.0F)},
      grid);
}

/// Up to 1e6 away from the origin; often along z, whose term is added last, so that both sums before it round coarsely.
ShaftInput distant_shaft_with_planes(Random& random) {
  const float distance = std::pow(10.0F, random.uniform(2.0F, 6.0F));
  return with_planes(random, distant_shaft(random, distance, random.one_in(2) ? 4U : 0U), false);
}

TEST(AddedPlanes, BoxesAtThePlaneGetTheExactSign) {
  constexpr std::uint64_t seed = 41;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const ShaftInput input = shaft_with_planes(random, false);
    std::vector<Box> boxes;
    for (int j = 0; j != 40; ++j)
      boxes.push_back(random.one_in(3) ? nearby_box(random, input) : box_at_plane(random, input));
    expect_exact(input, boxes);
  }
}

TEST(AddedPlanes, BoxesFarFromTheOriginAreAnsweredExactly) {
  constexpr std::uint64_t seed = 46;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != 250 && !HasFailure(); ++i) {
    const ShaftInput input = distant_shaft_with_planes(random);
    std::vector<Box> boxes;
    for (int j = 0; j != 40; ++j)
      boxes.push_back(random.one_in(4) ? nearby_box(random, input) : box_at_plane(random, input));
    expect_exact(input, boxes);
  }
}

TEST(AddedPlanes, SpheresFarFromTheOriginAreAnsweredExactly) {
  constexpr std::uint64_t seed = 47;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != 250 && !HasFailure(); ++i) {
    const ShaftInput input = distant_shaft_with_planes(random);
    std::vector<Sphere> spheres;
    for (int j = 0; j != 24; ++j) {
      spheres.push_back(random.one_in(4) ? random_sphere(random, input) : sphere_at_plane(random, input));
    }
    expect_exact(input, spheres);
  }
}

TEST(AddedPlanes, GridAlignedBoxesAreAnsweredExactly) {
  constexpr std::uint64_t seed = 42;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const ShaftInput input = shaft_with_planes(random, true);
    std::vector<Box> boxes;
    for (int j = 0; j != 40; ++j) boxes.push_back(random.grid_box(0, 8));
    expect_exact(input, boxes);
  }
}

TEST(AddedPlanes, SpheresAtThePlaneGetTheExactSign) {
  constexpr std::uint64_t seed = 43;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const ShaftInput input = shaft_with_planes(random, false);
    std::vector<Sphere> spheres;
    for (int j = 0; j != 40; ++j) {
      spheres.push_back(random.one_in(3) ? random_sphere(random, input) : sphere_at_plane(random, input));
    }
    expect_exact(input, spheres);
  }
}

TEST(AddedPlanes, GridAlignedSpheresAreAnsweredExactly) {
  constexpr std::uint64_t seed = 44;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const ShaftInput input = shaft_with_planes(random, true);
    std::vector<Sphere> spheres;
    for (int j = 0; j != 40; ++j) {
      spheres.push_back({{random.integer(0, 8), random.integer(0, 8), random.integer(0, 8)}, random.integer(0, 4)});
    }
    expect_exact(input, spheres);
  }
}

TEST(AddedPlanes, HugeAndTinyNormalsNeitherOverflowNorVanish) {
  constexpr std::uint64_t seed = 45;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const ShaftInput input = with_wild_planes(random, random_shaft(random));
    const oracle::QuickHull hull(input);
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (int j = 0; j != 20; ++j) {
      boxes.push_back(random.one_in(2) ? nearby_box(random, input) : boundless_box(random));
      spheres.push_back(random.one_in(2) ? random_sphere(random, input) : boundless_sphere(random, input, hull));
    }
    expect_exact(input, boxes);
    expect_exact(input, spheres);
  }
}

TEST(AddedPlanes, APlaneThatNothingMeetsCullsEverything) {
  const ShaftInput input{{{0, 0, 0}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}, {{{1, 0, 0}, -10}}};
  expect_answers(input, {Box{{0, 0, 0}, {1, 1, 1}}, Box{{-5, -5, -5}, {5, 5, 5}}, Box{{-20, -5, -5}, {5, 5, 5}}},
                 {Answer::outside, Answer::outside, Answer::overlap});
  expect_answers(input, {Sphere{{0, 0, 0}, 1}, Sphere{{0, 0, 0}, 10}}, {Answer::outside, Answer::overlap});
}

}  // namespace
}  // namespace shaftcull
