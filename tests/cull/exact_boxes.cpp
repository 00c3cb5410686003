// SPDX-License-Identifier: MIT
/// Boxes: every answer equals the one of exact arithmetic.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cull/agreement.hpp"
#include "oracle/cases/bounds.hpp"
#include "oracle/cases/shafts.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

/// Checks `shafts` random inputs, each with the boxes that `boxes_of` makes for it.
template <class MakeShaft, class MakeBoxes>
void expect_exact_boxes(std::uint64_t seed, std::size_t shafts, const MakeShaft& shaft_of, const MakeBoxes& boxes_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (std::size_t i = 0; i != random_cases(shafts) && !testing::Test::HasFailure(); ++i) {
    const ShaftInput input = shaft_of(random);
    expect_exact(input, boxes_of(random, input));
  }
}

template <class MakeBox>
auto boxes_by(std::size_t count, const MakeBox& make) {
  return [count, make](Random& random, const ShaftInput& input) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i != count; ++i) boxes.push_back(make(random, input));
    return boxes;
  };
}

Box touching(Random& random, const ShaftInput& input) { return touching_box(random, input); }

TEST(ExactBoxes, RandomBoxesAreAnsweredExactly) {
  expect_exact_boxes(1, 200, random_shaft,
                     boxes_by(64, [](Random& random, const ShaftInput&) { return random_box(random); }));
}

TEST(ExactBoxes, BoxesThatTouchOrNearlyTouchAreAnsweredExactly) {
  expect_exact_boxes(2, 250, random_shaft, boxes_by(64, touching));
}

TEST(ExactBoxes, BoxesThatTouchLongShaftsAreAnsweredExactly) {
  expect_exact_boxes(
      11, 80, [](Random& random) { return long_shaft(random); }, boxes_by(64, touching));
  expect_exact_boxes(
      12, 80, [](Random& random) { return long_shaft(random, true); }, boxes_by(64, touching));
}

TEST(ExactBoxes, GridAlignedBoxesAreAnsweredExactly) {
  expect_exact_boxes(
      3, 250, [](Random& random) { return grid_shaft(random); },
      boxes_by(64, [](Random& random, const ShaftInput&) { return random.grid_box(0, 8); }));
}

TEST(ExactBoxes, DegenerateShaftsAnswerExactly) {
  expect_exact_boxes(4, 200, degenerate_shaft, boxes_by(32, touching));
  expect_exact_boxes(5, 100, degenerate_shaft,
                     boxes_by(32, [](Random& random, const ShaftInput&) { return random_box(random); }));
}

TEST(ExactBoxes, ShaftsFarFromTheOriginAnswerExactly) {
  for (const float distance : {1e3F, 1e4F, 1e5F, 1e7F}) {
    expect_exact_boxes(
        6, 60, [distance](Random& random) { return distant_shaft(random, distance); },
        boxes_by(32, [](Random& random, const ShaftInput& of) {
          return random.one_in(4) ? nearby_box(random, of) : touching_box(random, of);
        }));
  }
}

TEST(ExactBoxes, ShaftsOfNearlyEqualFacesAnswerExactly) {
  expect_exact_boxes(7, 150, nearly_equal_shaft, boxes_by(32, touching));
}

TEST(ExactBoxes, EveryMagnitudeFromDenormalsTo1e38IsAnsweredExactly) {
  // First one scale for the whole scene, then a scale of its own for each coordinate.
  for (const int exponent : {-149, -140, -126, -100, -64, 64, 100, 126}) {
    const int most = std::min(exponent + 6, 127);
    expect_exact_boxes(
        8, 15, [=](Random& random) { return wild_shaft(random, exponent, most); },
        boxes_by(32, [=](Random& random, const ShaftInput& of) {
          return random.one_in(2) ? wild_box(random, exponent, most) : touching_box(random, of);
        }));
  }
  expect_exact_boxes(
      9, 150, [](Random& random) { return wild_shaft(random); }, boxes_by(32, [](Random& random, const ShaftInput& of) {
        return random.one_in(2) ? wild_box(random) : touching_box(random, of);
      }));
}

TEST(ExactBoxes, BoxesOfAnySizeAroundAnOrdinaryShaftAreAnsweredExactly) {
  expect_exact_boxes(13, 100, random_shaft,
                     boxes_by(64, [](Random& random, const ShaftInput&) { return boundless_box(random); }));
}

/// Most of them in the relative form.
TEST(ExactBoxes, SweepsThatEndFarBeyondTheSceneAnswerExactly) {
  expect_exact_boxes(14, 250, far_sweep_shaft, boxes_by(64, touching_far_sweep));
  expect_exact_boxes(15, 100, far_sweep_shaft,
                     boxes_by(64, [](Random& random, const ShaftInput&) { return random_box(random); }));
  expect_exact_boxes(16, 60, far_sweep_shaft, boxes_by(32, [](Random& random, const ShaftInput& of) {
                       return random.one_in(2) ? touching_box(random, of) : boundless_box(random);
                     }));
}

TEST(ExactBoxes, EveryColouringOfTheFacesAnswersExactly) {
  constexpr std::uint64_t seed = 10;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (unsigned colouring = 0; colouring != colourings && !HasFailure(); ++colouring) {
    const ShaftInput input = coloured_shaft(colouring);
    std::vector<Box> boxes;
    for (int i = 0; i != 12; ++i) boxes.push_back(random.grid_box(-1, 5));
    for (int i = 0; i != 12; ++i) boxes.push_back(touching_box(random, input));
    for (int i = 0; i != 8; ++i) boxes.push_back(random.box(-1, 5, 0.0F, 0.3F));
    expect_exact(input, boxes);
  }
}

}  // namespace
}  // namespace shaftcull
