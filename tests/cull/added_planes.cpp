/// Planes that the user adds: the sign at the near and far corner is the exact one.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cull/agreement.hpp"
#include "dice.hpp"
#include "shaftcull/shaft.hpp"

namespace shaftcull {
namespace {

/// A plane through `point`, as nearly as its offset can be rounded.
Plane plane_through(Dice& dice, const Vec3& point, bool grid) {
  Plane plane{};
  do {
    for (float& n : plane.normal) n = grid ? dice.integer(-3, 3) : dice.one_in(4) ? 0.0F : dice.uniform(-2, 2);
  } while (plane.normal == Vec3{0, 0, 0});
  double offset = 0;
  for (std::size_t k = 0; k != 3; ++k) offset += static_cast<double>(plane.normal[k]) * static_cast<double>(point[k]);
  plane.offset = static_cast<float>(offset);
  if (!grid) plane.offset = dice.nudge(plane.offset);
  return plane;
}

Subject subject_with_planes(Dice& dice, bool grid) {
  Subject subject = grid ? Subject{dice.grid_box(0, 8), dice.grid_box(0, 8)}
                         : Subject{dice.box(-3, 3, 0.2F, 2.0F), dice.box(-3, 3, 0.2F, 2.0F)};
  const unsigned planes = 1 + dice.below(dice.one_in(4) ? 16 : 2);
  for (unsigned i = 0; i != planes; ++i) {
    subject.added.push_back(plane_through(dice, dice.one_in(2) ? subject.a.lo : subject.b.hi, grid));
  }
  return subject;
}

/// A box with one corner on an added plane, as nearly as can be.
Box box_at_plane(Dice& dice, const Subject& subject) {
  const Plane& plane = subject.added[dice.below(static_cast<unsigned>(subject.added.size()))];
  Box box = dice.box(-3, 3, 0.05F, 0.5F);
  Vec3 corner{};
  for (std::size_t k = 0; k != 3; ++k) corner[k] = dice.one_in(2) ? box.lo[k] : box.hi[k];
  std::size_t axis = 0;
  for (std::size_t k = 1; k != 3; ++k) {
    if (std::abs(plane.normal[k]) > std::abs(plane.normal[axis])) axis = k;
  }
  double rest = static_cast<double>(plane.offset);
  for (std::size_t k = 0; k != 3; ++k) {
    if (k != axis) rest -= static_cast<double>(plane.normal[k]) * static_cast<double>(corner[k]);
  }
  const float x = dice.nudge(static_cast<float>(rest / static_cast<double>(plane.normal[axis])));
  const float size = box.hi[axis] - box.lo[axis];
  box.lo[axis] = dice.one_in(2) ? x : x - size;
  box.hi[axis] = std::max(box.lo[axis] == x ? x + size : x, box.lo[axis]);
  return box;
}

TEST(AddedPlanes, BoxesAtThePlaneGetTheExactSign) {
  constexpr std::uint64_t seed = 41;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (int i = 0; i != 150 && !HasFailure(); ++i) {
    const Subject subject = subject_with_planes(dice, false);
    std::vector<Box> boxes;
    for (int j = 0; j != 40; ++j) boxes.push_back(dice.one_in(3) ? dice.box(-4, 4, 0.1F, 1) : box_at_plane(dice, subject));
    expect_exact(subject, boxes);
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
      const Vec3 centre = dice.vec3(-4, 4);
      const Plane& plane = subject.added[dice.below(static_cast<unsigned>(subject.added.size()))];
      double height = -static_cast<double>(plane.offset);
      double squared = 0;
      for (std::size_t k = 0; k != 3; ++k) {
        height += static_cast<double>(plane.normal[k]) * static_cast<double>(centre[k]);
        squared += static_cast<double>(plane.normal[k]) * static_cast<double>(plane.normal[k]);
      }
      const float touching = dice.nudge(static_cast<float>(std::abs(height) / std::sqrt(squared)));
      spheres.push_back({centre, dice.one_in(3) ? dice.uniform(0, 1) : std::max(0.0F, touching)});
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
    Subject subject{dice.box(-3, 3, 0.2F, 2.0F), dice.box(-3, 3, 0.2F, 2.0F)};
    subject.added.push_back({{dice.wild(), dice.wild(), dice.wild()}, dice.wild()});
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (int j = 0; j != 20; ++j) {
      boxes.push_back(dice.box(-4, 4, 0.1F, 2.0F));
      spheres.push_back({dice.vec3(-4, 4), dice.uniform(0, 2)});
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
