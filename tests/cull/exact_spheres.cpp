/// Spheres: every answer equals the one of exact arithmetic.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cull/agreement.hpp"
#include "cull/touching.hpp"
#include "dice.hpp"
#include "oracle.hpp"

namespace shaftcull {
namespace {

/// Checks `shafts` random subjects against `count` spheres each, made from the subject's hull.
template <class MakeSubject, class MakeSphere>
void check(std::uint64_t seed, std::size_t shafts, std::size_t count, const MakeSubject& subject_of,
           const MakeSphere& sphere_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (std::size_t i = 0; i != shafts && !testing::Test::HasFailure(); ++i) {
    const Subject subject = subject_of(dice);
    const oracle::Hull hull(subject.a, subject.b);
    std::vector<Sphere> spheres;
    for (std::size_t j = 0; j != count; ++j) spheres.push_back(sphere_of(dice, subject, hull));
    expect_exact(subject, spheres);
  }
}

Subject random_subject(Dice& dice) { return {dice.box(-5, 5, 0.2F, 1.0F), dice.box(-5, 5, 0.2F, 1.0F)}; }

/// A point around the shaft, as often in it as not.
Vec3 random_centre(Dice& dice, const Subject& subject) {
  const float t = dice.uniform(0.0F, 1.0F);
  Vec3 centre{};
  for (std::size_t k = 0; k != 3; ++k) {
    const float from = dice.uniform(subject.a.lo[k], subject.a.hi[k]);
    const float to = dice.uniform(subject.b.lo[k], subject.b.hi[k]);
    centre[k] = from + t * (to - from) + dice.uniform(-0.7F, 0.7F);
  }
  return centre;
}

Sphere random_sphere(Dice& dice, const Subject& subject, const oracle::Hull& /*hull*/) {
  return {random_centre(dice, subject), dice.one_in(8) ? 0.0F : dice.uniform(0.0F, dice.one_in(4) ? 3.0F : 0.4F)};
}

Sphere near_sphere(Dice& dice, const Subject& subject, const oracle::Hull& hull) {
  return touching_sphere(dice, hull, random_centre(dice, subject));
}

TEST(ExactSpheres, RandomSpheres) { check(21, 150, 64, random_subject, random_sphere); }

TEST(ExactSpheres, SpheresThatTouchOrNearlyTouch) { check(22, 150, 64, random_subject, near_sphere); }

TEST(ExactSpheres, GridAlignedSpheres) {
  check(23, 150, 64, [](Dice& dice) { return Subject{dice.grid_box(0, 8), dice.grid_box(0, 8)}; },
        [](Dice& dice, const Subject&, const oracle::Hull&) {
          return Sphere{{dice.integer(-4, 12), dice.integer(-4, 12), dice.integer(-4, 12)}, dice.integer(0, 6)};
        });
}

TEST(ExactSpheres, DegenerateShafts) {
  const auto subject = [](Dice& dice) {
    const Vec3 p = dice.vec3(-2, 2);
    const Vec3 q = dice.vec3(-2, 2);
    switch (dice.below(4)) {
      case 0: return Subject{{p, p}, {p, p}};
      case 1: return Subject{{p, p}, {q, q}};
      case 2: return Subject{Dice::sorted(p, q), Dice::sorted(p, q)};
      default: {
        Box flat = Dice::sorted(p, q);
        flat.hi[1] = flat.lo[1];
        return Subject{flat, {p, p}};
      }
    }
  };
  check(24, 120, 24, subject, near_sphere);
  check(25, 60, 24, subject, [](Dice& dice, const Subject& of, const oracle::Hull&) {
    // Centres on the shaft's own corners, where every distance is 0.
    return Sphere{dice.one_in(2) ? of.a.lo : of.b.hi, dice.one_in(2) ? 0.0F : dice.uniform(0.0F, 1.0F)};
  });
}

TEST(ExactSpheres, ShaftsFarFromTheOrigin) {
  for (const float offset : {1e3F, 1e5F, 1e7F}) {
    const auto make_subject = [offset](Dice& dice) {
      Subject subject = random_subject(dice);
      for (Box* box : {&subject.a, &subject.b}) {
        for (std::size_t k = 0; k != 3; ++k) {
          box->lo[k] += offset;
          box->hi[k] += offset;
        }
      }
      return subject;
    };
    check(26, 40, 24, make_subject, random_sphere);
    check(27, 40, 24, make_subject, near_sphere);
  }
}

TEST(ExactSpheres, EveryMagnitudeFromDenormalsTo1e38) {
  for (const int exponent : {-149, -140, -126, -100, -64, 64, 100, 122}) {
    const auto wild = [exponent](Dice& dice) { return dice.wild(exponent, exponent + 4); };
    const auto wild_box = [wild](Dice& dice) {
      return Dice::sorted({wild(dice), wild(dice), wild(dice)}, {wild(dice), wild(dice), wild(dice)});
    };
    check(28, 15, 24, [wild_box](Dice& dice) { return Subject{wild_box(dice), wild_box(dice)}; },
          [wild](Dice& dice, const Subject&, const oracle::Hull&) {
            return Sphere{{wild(dice), wild(dice), wild(dice)}, std::abs(wild(dice))};
          });
  }
  const auto mixed_box = [](Dice& dice) {
    return Dice::sorted({dice.wild(), dice.wild(), dice.wild()}, {dice.wild(), dice.wild(), dice.wild()});
  };
  check(29, 120, 24, [mixed_box](Dice& dice) { return Subject{mixed_box(dice), mixed_box(dice)}; },
        [](Dice& dice, const Subject&, const oracle::Hull&) {
          return Sphere{{dice.wild(), dice.wild(), dice.wild()}, std::abs(dice.wild())};
        });
}

TEST(ExactSpheres, EveryColouringOfTheFaces) {
  constexpr std::uint64_t seed = 30;
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
    const oracle::Hull hull(subject.a, subject.b);
    std::vector<Sphere> spheres;
    for (int i = 0; i != 8; ++i) {
      spheres.push_back({{dice.integer(-2, 6), dice.integer(-2, 6), dice.integer(-2, 6)}, dice.integer(0, 3)});
      spheres.push_back(touching_sphere(dice, hull, dice.vec3(-2, 6)));
    }
    expect_exact(subject, spheres);
  }
}

}  // namespace
}  // namespace shaftcull
