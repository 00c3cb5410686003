/// Boxes: every answer equals the one of exact arithmetic.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cases/bounds.hpp"
#include "cases/shafts.hpp"
#include "cull/agreement.hpp"
#include "dice.hpp"
#include "effort.hpp"

namespace shaftcull {
namespace {

/// Checks `shafts` random subjects, each with the boxes that `boxes_of` makes for it.
template <class MakeSubject, class MakeBoxes>
void check(std::uint64_t seed, std::size_t shafts, const MakeSubject& subject_of, const MakeBoxes& boxes_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (std::size_t i = 0; i != effort(shafts) && !testing::Test::HasFailure(); ++i) {
    const Subject subject = subject_of(dice);
    expect_exact(subject, boxes_of(dice, subject));
  }
}

template <class MakeBox>
auto many(std::size_t count, const MakeBox& make) {
  return [count, make](Dice& dice, const Subject& subject) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i != count; ++i) boxes.push_back(make(dice, subject));
    return boxes;
  };
}

TEST(ExactBoxes, RandomBoxes) {
  check(1, 200, random_subject, many(64, [](Dice& dice, const Subject&) { return random_box(dice); }));
}

TEST(ExactBoxes, BoxesThatTouchOrNearlyTouch) { check(2, 250, random_subject, many(64, touching_box)); }

TEST(ExactBoxes, BoxesThatTouchLongShafts) {
  check(
      11, 80, [](Dice& dice) { return long_subject(dice); }, many(64, touching_box));
  check(
      12, 80, [](Dice& dice) { return long_subject(dice, true); }, many(64, touching_box));
}

TEST(ExactBoxes, GridAlignedBoxes) {
  check(
      3, 250, [](Dice& dice) { return grid_subject(dice); },
      many(64, [](Dice& dice, const Subject&) { return dice.grid_box(0, 8); }));
}

TEST(ExactBoxes, DegenerateShafts) {
  check(4, 200, degenerate_subject, many(32, touching_box));
  check(5, 100, degenerate_subject, many(32, [](Dice& dice, const Subject&) { return random_box(dice); }));
}

TEST(ExactBoxes, ShaftsFarFromTheOrigin) {
  for (const float distance : {1e3F, 1e4F, 1e5F, 1e7F}) {
    check(
        6, 60, [distance](Dice& dice) { return distant_subject(dice, distance); },
        many(32, [](Dice& dice, const Subject& of) {
          return dice.one_in(4) ? nearby_box(dice, of) : touching_box(dice, of);
        }));
  }
}

TEST(ExactBoxes, NearlyEqualFaces) { check(7, 150, nearly_equal_subject, many(32, touching_box)); }

TEST(ExactBoxes, EveryMagnitudeFromDenormalsTo1e38) {
  // One scale for the whole scene, then scales mixed without mercy.
  for (const int exponent : {-149, -140, -126, -100, -64, 64, 100, 126}) {
    const int most = std::min(exponent + 6, 127);
    check(
        8, 15, [=](Dice& dice) { return wild_subject(dice, exponent, most); },
        many(32, [=](Dice& dice, const Subject& of) {
          return dice.one_in(2) ? wild_box(dice, exponent, most) : touching_box(dice, of);
        }));
  }
  check(
      9, 150, [](Dice& dice) { return wild_subject(dice); },
      many(32, [](Dice& dice, const Subject& of) { return dice.one_in(2) ? wild_box(dice) : touching_box(dice, of); }));
}

TEST(ExactBoxes, BoxesOfAnySizeAroundAnOrdinaryShaft) {
  check(13, 100, random_subject, many(64, [](Dice& dice, const Subject&) { return boundless_box(dice); }));
}

/// Most of them in the relative form.
TEST(ExactBoxes, SweepsThatEndFarBeyondTheScene) {
  check(14, 250, far_sweep_subject, many(64, touching_far_sweep));
  check(15, 100, far_sweep_subject, many(64, [](Dice& dice, const Subject&) { return random_box(dice); }));
  check(16, 60, far_sweep_subject, many(32, [](Dice& dice, const Subject& of) {
          return dice.one_in(2) ? touching_box(dice, of) : boundless_box(dice);
        }));
}

TEST(ExactBoxes, EveryColouringOfTheFaces) {
  constexpr std::uint64_t seed = 10;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (unsigned colouring = 0; colouring != colourings && !HasFailure(); ++colouring) {
    const Subject subject = coloured_subject(colouring);
    std::vector<Box> boxes;
    for (int i = 0; i != 12; ++i) boxes.push_back(dice.grid_box(-1, 5));
    for (int i = 0; i != 12; ++i) boxes.push_back(touching_box(dice, subject));
    for (int i = 0; i != 8; ++i) boxes.push_back(dice.box(-1, 5, 0.0F, 0.3F));
    expect_exact(subject, boxes);
  }
}

}  // namespace
}  // namespace shaftcull
