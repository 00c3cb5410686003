/// Spheres: every answer equals the one of exact arithmetic.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cases/bounds.hpp"
#include "cases/shafts.hpp"
#include "cull/agreement.hpp"
#include "dice.hpp"
#include "effort.hpp"
#include "quick_oracle.hpp"

namespace shaftcull {
namespace {

/// Checks `shafts` random subjects against `count` spheres each, made from the subject's hull.
template <class MakeSubject, class MakeSphere>
void check(std::uint64_t seed, std::size_t shafts, std::size_t count, const MakeSubject& subject_of,
           const MakeSphere& sphere_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (std::size_t i = 0; i != effort(shafts) && !testing::Test::HasFailure(); ++i) {
    const Subject subject = subject_of(dice);
    const oracle::QuickHull hull(subject);
    std::vector<Sphere> spheres;
    for (std::size_t j = 0; j != count; ++j) spheres.push_back(sphere_of(dice, subject, hull));
    expect_exact(subject, spheres);
  }
}

Sphere random(Dice& dice, const Subject& subject, const oracle::QuickHull& /*hull*/) {
  return random_sphere(dice, subject);
}

Sphere near_sphere(Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
  return touching_sphere(dice, hull, random_centre(dice, subject));
}

TEST(ExactSpheres, RandomSpheres) { check(21, 150, 64, random_subject, random); }

TEST(ExactSpheres, SpheresThatTouchOrNearlyTouch) { check(22, 150, 64, random_subject, near_sphere); }

TEST(ExactSpheres, GridAlignedSpheres) {
  check(
      23, 150, 64, [](Dice& dice) { return grid_subject(dice); },
      [](Dice& dice, const Subject&, const oracle::QuickHull&) {
        return Sphere{{dice.integer(-4, 12), dice.integer(-4, 12), dice.integer(-4, 12)}, dice.integer(0, 6)};
      });
}

TEST(ExactSpheres, DegenerateShafts) {
  check(24, 150, 24, degenerate_subject, near_sphere);
  check(25, 60, 24, degenerate_subject, [](Dice& dice, const Subject& of, const oracle::QuickHull&) {
    // Centres on the shaft's own corners, where every distance is 0.
    return Sphere{dice.one_in(2) ? of.a.lo : of.b.hi, dice.one_in(2) ? 0.0F : dice.uniform(0.0F, 1.0F)};
  });
}

TEST(ExactSpheres, ShaftsFarFromTheOrigin) {
  for (const float distance : {1e3F, 1e4F, 1e5F, 1e7F}) {
    const auto subject = [distance](Dice& dice) { return distant_subject(dice, distance); };
    check(26, 40, 24, subject, random);
    check(27, 40, 24, subject, near_sphere);
  }
}

TEST(ExactSpheres, RadiiAsSmallAsRoundingErrors) {
  check(
      32, 400, 32, [](Dice& dice) { return long_subject(dice); }, tiny_sphere);
  check(
      33, 200, 32, [](Dice& dice) { return long_subject(dice, true); }, tiny_sphere);
}

TEST(ExactSpheres, SpheresOnJoiningPlanes) {
  // Errors without multiply-add that add up to more than a tenth of what is allowed for them, which dice seldom throw.
  expect_exact(
      Subject{{{-0x1.3649b8p+2F, 0x1.e0a8aap+1F, -0x1.bfaep+1F}, {-0x1.188554p+2F, 0x1.617d0cp+2F, -0x1.bfaep+1F}},
              {{0x1.06486ep-1F, 0x1.c43a78p+1F, 0x1.1afd24p+0F}, {0x1.188f08p+0F, 0x1.08c944p+2F, 0x1.c677bcp+0F}},
              {}},
      std::vector<Sphere>{{{-0x1.4ab0f4p+3F, -0x1.d31976p+7F, 0x1.bc966p-1F}, 0x1.daa838p+7F}});
  check(34, 100, 32, random_subject, resting_sphere);
  check(
      35, 50, 32, [](Dice& dice) { return long_subject(dice, true); }, resting_sphere);
}

// A distance that is less than the radius by so little that it is rounded to it, in doubles too.
TEST(ExactSpheres, ASphereAsFarFromAFaceAsItsRadiusButForADenormal) {
  const Box box{{0x1p-140F, -4, -4}, {4, 4, 4}};
  const Box ends_at_zero{{0, -4, -4}, {4, 4, 4}};
  const Sphere sphere{{1, 0, 0}, 1};
  expect_exact(Subject{box, box}, std::vector<Sphere>{sphere});
  expect_exact(Subject{ends_at_zero, ends_at_zero}, std::vector<Sphere>{sphere});
  expect_exact(Subject{{{-4, -4, -4}, {-0x1p-140F, 4, 4}}, {{-4, -4, -4}, {-0x1p-140F, 4, 4}}},
               std::vector<Sphere>{{{-1, 0, 0}, 1}, {{1, 0, 0}, 1}});
}

// Whole numbers, of which exact answers need no expansions, at any magnitude that floats have.
TEST(ExactSpheres, SpheresAndPointsThatTouchOnAGrid) {
  for (const int exponent : {-149, -130, -60, 0, 60, 121}) {
    const auto subject = [exponent](Dice& dice) { return pythagorean_subject(dice, exponent); };
    check(38, 60, 64, subject,
          [exponent](Dice& dice, const Subject&, const oracle::QuickHull&) { return whole_sphere(dice, exponent); });
    check(39, 60, 64, subject, [exponent](Dice& dice, const Subject&, const oracle::QuickHull& hull) {
      return whole_touching_sphere(dice, hull, exponent);
    });
  }
}

// Decimal fractions: none of them is a float, and what would touch is off by the last bits.
TEST(ExactSpheres, SpheresAndPointsOnAGridOfTenths) {
  const auto tenths = [](const Box& box) {
    Box scaled = box;
    for (std::size_t k = 0; k != 3; ++k) {
      scaled.lo[k] *= 0.1F;
      scaled.hi[k] *= 0.1F;
    }
    return scaled;
  };
  const auto subject = [tenths](Dice& dice) {
    const Subject whole = pythagorean_subject(dice);
    return Subject{tenths(whole.a), tenths(whole.b)};
  };
  check(40, 150, 64, subject, [](Dice& dice, const Subject&, const oracle::QuickHull&) {
    Sphere sphere = whole_sphere(dice);
    for (float& x : sphere.centre) x *= 0.1F;
    sphere.radius *= 0.1F;
    return sphere;
  });
}

TEST(ExactSpheres, NearlyEqualFaces) { check(31, 100, 24, nearly_equal_subject, near_sphere); }

TEST(ExactSpheres, EveryMagnitudeFromDenormalsTo1e38) {
  for (const int exponent : {-149, -140, -126, -100, -64, 64, 100, 122}) {
    const auto wild = [exponent](Dice& dice) { return dice.wild(exponent, exponent + 4); };
    check(
        28, 15, 24, [exponent](Dice& dice) { return wild_subject(dice, exponent, exponent + 4); },
        [wild](Dice& dice, const Subject&, const oracle::QuickHull&) {
          return Sphere{{wild(dice), wild(dice), wild(dice)}, std::abs(wild(dice))};
        });
  }
  check(
      29, 120, 24, [](Dice& dice) { return wild_subject(dice); },
      [](Dice& dice, const Subject&, const oracle::QuickHull&) {
        return Sphere{{dice.wild(), dice.wild(), dice.wild()}, std::abs(dice.wild())};
      });
}

// Squares of slopes overflowed, and what they should have bounded was taken for nothing: in both forms, or with rounded
// multiply-adds only.
TEST(ExactSpheres, SpheresBesideHugeShafts) {
  const Box point{{0, 0x1p+73F, 0}, {0, 0x1p+73F, 0}};
  const Box end{{0x1.9fdf8cp+68F, -0x1p+73F, 0}, {0x1.9fdf8cp+68F, -0x1p+73F, 0}};
  const Sphere sphere{{-0x1.3b2c48p+59F, 0x1.ff1124p+72F, 0}, 0x1p+60F};
  expect_exact(Subject{point, end, {}}, std::vector<Sphere>{sphere});
  const auto turned = [](const Vec3& v) { return Vec3{v[1], v[0], v[2]}; };
  expect_exact(Subject{{turned(point.lo), turned(point.hi)}, {turned(end.lo), turned(end.hi)}, {}},
               std::vector<Sphere>{{turned(sphere.centre), sphere.radius}});
  check(37, 100, 64, huge_subject, sphere_beside_huge);
}

TEST(ExactSpheres, SpheresOfAnySizeAroundAnOrdinaryShaft) { check(36, 60, 32, random_subject, boundless_sphere); }

TEST(ExactSpheres, EveryColouringOfTheFaces) {
  constexpr std::uint64_t seed = 30;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  for (unsigned colouring = 0; colouring != colourings && !HasFailure(); ++colouring) {
    const Subject subject = coloured_subject(colouring);
    const oracle::QuickHull hull(subject);
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
