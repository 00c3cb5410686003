// SPDX-License-Identifier: MIT
/// Infinite and empty bounds have their answers; NaN has one too, and the same everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "columns.hpp"
#include "cull/agreement.hpp"
#include "forms.hpp"
#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

constexpr Box everything{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
constexpr Box empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

/// Shafts of all kinds: plain, parallel faces, equal boxes, points, a flat one, with added planes.
std::vector<ShaftInput> inputs() {
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  const Box away{{3, -2, 5}, {4, -1, 6}};
  const Box shifted{{2, 0, 0}, {3, 1, 1}};
  const Box point{{0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}};
  return {{unit, away},   {unit, shifted}, {unit, unit},
          {point, point}, {point, away},   {unit, away, {{{1, 0, 0}, 2}, {{1, -1, 0.5F}, 1}}}};
}

TEST(SpecialValues, EverythingIsAlwaysKeptAndNeverInside) {
  for (const ShaftInput& input : inputs()) {
    expect_answers(input, {everything}, {Answer::overlap});
    expect_answers(input, {Sphere{{0, 0, 0}, infinity}}, {Answer::overlap});
  }
}

TEST(SpecialValues, TheEmptyBoxIsAlwaysOutside) {
  for (const ShaftInput& input : inputs()) expect_answers(input, {empty}, {Answer::outside});
}

TEST(SpecialValues, TheEmptyBoxIsNotContained) {
  const BoxColumns memory({empty});
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const ShaftInput& input : inputs()) {
      std::vector<std::uint64_t> inside{~std::uint64_t{0}};
      classify(compile(input.a, input.b), memory.view(), {}, inside);
      EXPECT_EQ(inside[0], 0U) << name(isa) << "\n" << source_text(input);
    }
  }
}

TEST(SpecialValues, HalfInfiniteBoxesAnswerLikeUnboundedOnes) {
  constexpr std::uint64_t seed = 61;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (const ShaftInput& input : inputs()) {
    std::vector<Box> boxes;
    for (int i = 0; i != 200; ++i) {
      Box box = random.one_in(2) ? random.grid_box(-3, 6) : random.box(-3, 6, 0, 2);
      for (std::size_t k = 0; k != 3; ++k) {
        if (random.one_in(3)) box.lo[k] = -infinity;
        if (random.one_in(3)) box.hi[k] = infinity;
      }
      boxes.push_back(box);
    }
    expect_exact(input, boxes);
  }
}

TEST(SpecialValues, TheLargestFiniteBoundsAreNotTakenForInfinite) {
  constexpr float most = std::numeric_limits<float>::max();
  for (const ShaftInput& input : inputs()) {
    expect_exact(input, {Box{{-most, -most, -most}, {most, most, most}}, Box{{most, 0, 0}, {most, 1, 1}},
                         Box{{-most, -most, -most}, {-most, -most, -most}}});
    expect_exact(input, {Sphere{{0, 0, 0}, most}, Sphere{{most, -most, most}, most}, Sphere{{most, 0, 0}, 1}});
  }
}

TEST(SpecialValues, ARadiusOfMinusZeroMakesAPoint) {
  for (const ShaftInput& input : inputs()) {
    expect_exact(input, {Sphere{{1, 0, 0}, -0.0F}, Sphere{{0.5F, 0.5F, 0.5F}, -0.0F}, Sphere{{-1, 0, 0}, -0.0F}});
  }
}

TEST(SpecialValues, ASumThatOverflowsProvesNothing) {
  // n · c and r |n| are both beyond the largest float, and their difference has the sign of the smaller one's opposite.
  const ShaftInput input{Box{{0, 0, 0}, {1, 1, 1}},
                         Box{{2, -2, 5}, {4, -1, 6}},
                         {Plane{{0x1.8p+85F, -0x1.8p+67F, 0x1.8p+74F}, 0x1p-134F}}};
  expect_exact(input, {Sphere{{0x1p-142F, 0x1.5p-144F, 0x1p+55F}, 0x1.b6b6b6p+55F}, Sphere{{0, 0, 0x1p+55F}, 0x1p+56F},
                       Sphere{{0x1p+55F, 0, 0x1p+55F}, 0x1p+56F}});
}

/// Boxes with one to six coordinates NaN.
std::vector<Box> boxes_with_nan(Random& random) {
  std::vector<Box> boxes;
  for (int i = 0; i != 300; ++i) {
    Box box = random.one_in(8) ? everything : random.box(-3, 6, 0, 2);
    const unsigned which = 1 + random.below(63);
    for (unsigned k = 0; k != 3; ++k) {
      if ((which >> k & 1U) != 0) box.lo[k] = random.one_in(2) ? nan : -nan;
      if ((which >> (k + 3) & 1U) != 0) box.hi[k] = random.one_in(2) ? nan : -nan;
    }
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<Sphere> spheres_with_nan(Random& random) {
  std::vector<Sphere> spheres;
  for (int i = 0; i != 300; ++i) {
    Sphere sphere{random.vec3(-3, 6), random.one_in(8) ? infinity : random.uniform(0, 2)};
    const unsigned which = 1 + random.below(15);
    for (unsigned k = 0; k != 3; ++k) {
      if ((which >> k & 1U) != 0) sphere.centre[k] = random.one_in(2) ? nan : -nan;
    }
    if ((which >> 3U) != 0) sphere.radius = random.one_in(2) ? nan : -nan;
    spheres.push_back(sphere);
  }
  return spheres;
}

template <class Bound>
void expect_never_inside_and_same_everywhere(const std::vector<Bound>& bounds) {
  for (const ShaftInput& input : inputs()) {
    for (const Form form : forms) {
      std::vector<Answer> scalar;
      {
        const UseIsa use(Isa::scalar);
        scalar = answers(input, bounds, form);
      }
      for (std::size_t i = 0; i != bounds.size(); ++i) {
        EXPECT_NE(scalar[i], Answer::inside) << source_text(input) << "\n" << source_text(bounds[i]);
      }
      for (const Isa isa : isas_under_test()) {
        const UseIsa use(isa);
        const std::vector<Answer> vector = answers(input, bounds, form);
        for (std::size_t i = 0; i != bounds.size(); ++i) {
          EXPECT_EQ(vector[i], scalar[i]) << name(isa) << "\n" << source_text(input) << "\n" << source_text(bounds[i]);
        }
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(SpecialValues, NanIsNeverInsideAndAnswersTheSameOnEveryInstructionSet) {
  constexpr std::uint64_t seed = 62;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  expect_never_inside_and_same_everywhere(boxes_with_nan(random));
  expect_never_inside_and_same_everywhere(spheres_with_nan(random));
}

TEST(SpecialValues, NanCoordinatesNeverCull) {
  for (const ShaftInput& input : inputs()) {
    expect_answers(input, {Box{{nan, nan, nan}, {nan, nan, nan}}}, {Answer::overlap});
    expect_answers(input, {Sphere{{nan, nan, nan}, nan}, Sphere{{nan, nan, nan}, -nan}, Sphere{{nan, nan, nan}, 1}},
                   {Answer::overlap, Answer::overlap, Answer::overlap});
    // The other coordinates still may: these boxes are beyond the shaft box on another axis.
    expect_answers(
        input, {Box{{nan, 50, 0}, {nan, 60, 1}}, Box{{nan, 0.5F, 0.5F}, {nan, 0.5F, 0.5F}}},
        {Answer::outside, input.added.empty()
                              ? answers(input, {Box{{-infinity, 0.5F, 0.5F}, {infinity, 0.5F, 0.5F}}}, Form::slab)[0]
                              : Answer::overlap});
  }
}

TEST(SpecialValues, InvertedBoxesAnswerTheSameOnEveryInstructionSet) {
  constexpr std::uint64_t seed = 63;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::vector<Box> boxes;
  for (int i = 0; i != 300; ++i) {
    Box box = random.box(-3, 6, 0, 2);
    for (std::size_t k = 0; k != 3; ++k) {
      if (random.one_in(2)) std::swap(box.lo[k], box.hi[k]);
    }
    boxes.push_back(box);
  }
  for (const ShaftInput& input : inputs()) {
    for (const Form form : forms) {
      std::vector<Answer> scalar;
      {
        const UseIsa use(Isa::scalar);
        scalar = answers(input, boxes, form);
      }
      for (const Isa isa : isas_under_test()) {
        const UseIsa use(isa);
        EXPECT_EQ(answers(input, boxes, form), scalar) << name(isa) << "\n" << source_text(input);
      }
    }
  }
}

}  // namespace
}  // namespace shaftcull
