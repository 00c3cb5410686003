/// Boxes: every answer equals the one of exact arithmetic.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cull/agreement.hpp"
#include "cull/touching.hpp"
#include "dice.hpp"

namespace shaftcull {
namespace {

/// Checks `shafts` random subjects, each with the boxes that `boxes_of` makes for it.
template <class MakeSubject, class MakeBoxes>
void check(std::uint64_t seed, std::size_t shafts, const MakeSubject& subject_of, const MakeBoxes& boxes_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (std::size_t i = 0; i != shafts && !testing::Test::HasFailure(); ++i) {
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

Subject random_subject(Dice& dice) { return {dice.box(-5, 5, 0.2F, 1.0F), dice.box(-5, 5, 0.2F, 1.0F)}; }

Subject grid_subject(Dice& dice) { return {dice.grid_box(0, 8), dice.grid_box(0, 8)}; }

/// Two boxes of which the second is made from the first: equal, nested, touching, sharing faces, or points.
Subject degenerate_subject(Dice& dice) {
  const Box a = dice.box(-2, 2, 0.1F, 1.0F);
  Box b = a;
  switch (dice.below(5)) {
    case 0: break;
    case 1:
      for (std::size_t k = 0; k != 3; ++k) {
        b.lo[k] = a.lo[k] + (a.hi[k] - a.lo[k]) * 0.25F * dice.integer(0, 1);
        b.hi[k] = a.hi[k] - (a.hi[k] - a.lo[k]) * 0.25F * dice.integer(0, 1);
      }
      break;
    case 2: {
      const std::size_t axis = dice.below(3);
      b.lo[axis] = a.hi[axis];
      b.hi[axis] = a.hi[axis] + 1.0F;
      break;
    }
    case 3: b = {a.hi, a.hi}; break;
    default: {
      const Vec3 p = dice.vec3(-2, 2);
      const Vec3 q = dice.vec3(-2, 2);
      return {{p, p}, {q, q}};
    }
  }
  return dice.one_in(2) ? Subject{a, b} : Subject{b, a};
}

Box random_box(Dice& dice, const Subject& /*subject*/) {
  return dice.one_in(2) ? dice.box(-6, 6, 0.01F, 0.5F) : dice.box(-6, 6, 0.5F, 4.0F);
}

TEST(ExactBoxes, RandomBoxes) { check(1, 200, random_subject, many(64, random_box)); }

TEST(ExactBoxes, BoxesThatTouchOrNearlyTouch) { check(2, 250, random_subject, many(64, touching_box)); }

TEST(ExactBoxes, GridAlignedBoxes) {
  check(3, 250, grid_subject, many(64, [](Dice& dice, const Subject&) { return dice.grid_box(0, 8); }));
}

TEST(ExactBoxes, DegenerateShafts) {
  check(4, 200, degenerate_subject, many(32, touching_box));
  check(5, 100, degenerate_subject, many(32, random_box));
}

TEST(ExactBoxes, ShaftsFarFromTheOrigin) {
  for (const float offset : {1e3F, 1e5F, 1e7F}) {
    const auto make_subject = [offset](Dice& dice) {
      Subject subject = random_subject(dice);
      for (Box* box : {&subject.a, &subject.b}) {
        for (std::size_t k = 0; k != 3; ++k) {
          const float shift = k == 0 ? offset : -offset;
          box->lo[k] += shift;
          box->hi[k] += shift;
        }
      }
      return subject;
    };
    check(6, 60, make_subject, many(32, [offset](Dice& dice, const Subject& of) {
            if (dice.one_in(2)) return touching_box(dice, of);
            Box box = dice.box(-6, 6, 0.01F, 2.0F);
            for (std::size_t k = 0; k != 3; ++k) {
              const float shift = k == 0 ? offset : -offset;
              box.lo[k] += shift;
              box.hi[k] += shift;
            }
            return box;
          }));
  }
}

TEST(ExactBoxes, NearlyEqualFaces) {
  const auto make_subject = [](Dice& dice) {
    Subject subject{dice.box(-5, 5, 0.2F, 1.0F), {}};
    subject.b = subject.a;
    for (std::size_t k = 0; k != 3; ++k) {
      if (dice.one_in(2)) subject.b.lo[k] = std::min(dice.nudge(subject.a.lo[k]), subject.b.hi[k]);
      if (dice.one_in(2)) subject.b.hi[k] = std::max(dice.nudge(subject.a.hi[k]), subject.b.lo[k]);
    }
    const std::size_t axis = dice.below(3);
    if (dice.one_in(2)) subject.b.lo[axis] = subject.b.hi[axis] = subject.a.hi[axis] + 2.0F;
    return subject;
  };
  check(7, 150, make_subject, many(32, touching_box));
}

TEST(ExactBoxes, EveryMagnitudeFromDenormalsTo1e38) {
  // One scale for the whole scene, then scales mixed without mercy.
  for (const int exponent : {-149, -140, -126, -100, -64, 64, 100, 126}) {
    const auto wild = [exponent](Dice& dice) { return dice.wild(exponent, std::min(exponent + 6, 127)); };
    const auto wild_box = [wild](Dice& dice) {
      return Dice::sorted({wild(dice), wild(dice), wild(dice)}, {wild(dice), wild(dice), wild(dice)});
    };
    check(8, 15, [wild_box](Dice& dice) { return Subject{wild_box(dice), wild_box(dice)}; },
          many(32, [wild_box](Dice& dice, const Subject& of) {
            return dice.one_in(2) ? wild_box(dice) : touching_box(dice, of);
          }));
  }
  const auto mixed_box = [](Dice& dice) {
    return Dice::sorted({dice.wild(), dice.wild(), dice.wild()}, {dice.wild(), dice.wild(), dice.wild()});
  };
  check(9, 150, [mixed_box](Dice& dice) { return Subject{mixed_box(dice), mixed_box(dice)}; },
        many(32, [mixed_box](Dice& dice, const Subject& of) {
          return dice.one_in(2) ? mixed_box(dice) : touching_box(dice, of);
        }));
}

TEST(ExactBoxes, EveryColouringOfTheFaces) {
  constexpr std::uint64_t seed = 10;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (unsigned colouring = 0; colouring != 729 && !HasFailure(); ++colouring) {
    Subject subject{};
    unsigned digits = colouring;
    for (std::size_t k = 0; k != 3; ++k) {
      const float lo[3][2] = {{0, 1}, {1, 0}, {1, 1}};  // red, blue, purple
      const float hi[3][2] = {{4, 3}, {3, 4}, {3, 3}};
      subject.a.lo[k] = lo[digits % 3][0];
      subject.b.lo[k] = lo[digits % 3][1];
      subject.a.hi[k] = hi[digits / 3 % 3][0];
      subject.b.hi[k] = hi[digits / 3 % 3][1];
      digits /= 9;
    }
    std::vector<Box> boxes;
    for (int i = 0; i != 12; ++i) boxes.push_back(dice.grid_box(-1, 5));
    for (int i = 0; i != 12; ++i) boxes.push_back(touching_box(dice, subject));
    for (int i = 0; i != 8; ++i) boxes.push_back(dice.box(-1, 5, 0.0F, 0.3F));
    expect_exact(subject, boxes);
  }
}

}  // namespace
}  // namespace shaftcull
