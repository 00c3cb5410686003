/// Planes that the user adds: the sign at the near and far corner is the exact one.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cases/bounds.hpp"
#include "cases/shafts.hpp"
#include "cull/agreement.hpp"
#include "dice.hpp"
#include "shaftcull/shaft.hpp"

namespace shaftcull {
namespace {

Subject subject_with_planes(Dice& dice, bool grid) {
  return with_planes(
      dice, grid ? grid_subject(dice) : Subject{dice.box(-3, 3, 0.2F, 2.0F), dice.box(-3, 3, 0.2F, 2.0F)}, grid);
}

/// Up to 1e6 away from the origin; often along z, whose term is added last, so that both sums before it round coarsely.
Subject distant_subject_with_planes(Dice& dice) {
  const float distance = std::pow(10.0F, dice.uniform(2.0F, 6.0F));
  return with_planes(dice, distant_subject(dice, distance, dice.one_in(2) ? 4U : 0U), false);
}

TEST(AddedPlanes, BoxesAtThePlaneGetTheExactSign) {
  constexpr std::uint64_t seed = 41;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const Subject subject = subject_with_planes(dice, false);
    std::vector<Box> boxes;
    for (int j = 0; j != 40; ++j)
      boxes.push_back(dice.one_in(3) ? nearby_box(dice, subject) : box_at_plane(dice, subject));
    expect_exact(subject, boxes);
  }
}

TEST(AddedPlanes, BoxesFarFromTheOrigin) {
  constexpr std::uint64_t seed = 46;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 250 && !HasFailure(); ++i) {
    const Subject subject = distant_subject_with_planes(dice);
    std::vector<Box> boxes;
    for (int j = 0; j != 40; ++j)
      boxes.push_back(dice.one_in(4) ? nearby_box(dice, subject) : box_at_plane(dice, subject));
    expect_exact(subject, boxes);
  }
}

TEST(AddedPlanes, SpheresFarFromTheOrigin) {
  constexpr std::uint64_t seed = 47;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 250 && !HasFailure(); ++i) {
    const Subject subject = distant_subject_with_planes(dice);
    std::vector<Sphere> spheres;
    for (int j = 0; j != 24; ++j) {
      spheres.push_back(dice.one_in(4) ? random_sphere(dice, subject) : sphere_at_plane(dice, subject));
    }
    expect_exact(subject, spheres);
  }
}

TEST(AddedPlanes, GridAlignedBoxes) {
  constexpr std::uint64_t seed = 42;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const Subject subject = subject_with_planes(dice, true);
    std::vector<Box> boxes;
    for (int j = 0; j != 40; ++j) boxes.push_back(dice.grid_box(0, 8));
    expect_exact(subject, boxes);
  }
}

TEST(AddedPlanes, SpheresAtThePlaneGetTheExactSign) {
  constexpr std::uint64_t seed = 43;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const Subject subject = subject_with_planes(dice, false);
    std::vector<Sphere> spheres;
    for (int j = 0; j != 40; ++j) {
      spheres.push_back(dice.one_in(3) ? random_sphere(dice, subject) : sphere_at_plane(dice, subject));
    }
    expect_exact(subject, spheres);
  }
}

TEST(AddedPlanes, GridAlignedSpheres) {
  constexpr std::uint64_t seed = 44;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const Subject subject = subject_with_planes(dice, true);
    std::vector<Sphere> spheres;
    for (int j = 0; j != 40; ++j) {
      spheres.push_back({{dice.integer(0, 8), dice.integer(0, 8), dice.integer(0, 8)}, dice.integer(0, 4)});
    }
    expect_exact(subject, spheres);
  }
}

TEST(AddedPlanes, HugeAndTinyNormalsNeitherOverflowNorVanish) {
  constexpr std::uint64_t seed = 45;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const Subject subject = with_wild_planes(dice, random_subject(dice));
    const oracle::QuickHull hull(subject);
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (int j = 0; j != 20; ++j) {
      boxes.push_back(dice.one_in(2) ? nearby_box(dice, subject) : boundless_box(dice));
      spheres.push_back(dice.one_in(2) ? random_sphere(dice, subject) : boundless_sphere(dice, subject, hull));
    }
    expect_exact(subject, boxes);
    expect_exact(subject, spheres);
  }
}

TEST(AddedPlanes, APlaneThatNothingMeetsCullsEverything) {
  const Subject subject{{{0, 0, 0}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}, {{{1, 0, 0}, -10}}};
  expect_answers(subject, {Box{{0, 0, 0}, {1, 1, 1}}, Box{{-5, -5, -5}, {5, 5, 5}}, Box{{-20, -5, -5}, {5, 5, 5}}},
                 {Answer::outside, Answer::outside, Answer::overlap});
  expect_answers(subject, {Sphere{{0, 0, 0}, 1}, Sphere{{0, 0, 0}, 10}}, {Answer::outside, Answer::overlap});
}

}  // namespace
}  // namespace shaftcull
