// SPDX-License-Identifier: MIT
/// Spheres: every answer equals the one of exact arithmetic.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cull/agreement.hpp"
#include "oracle/cases/bounds.hpp"
#include "oracle/cases/shafts.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

/// Checks `shafts` random inputs against `count` spheres each, made from the input's hull.
template <class MakeShaft, class MakeSphere>
void expect_exact_spheres(std::uint64_t seed, std::size_t shafts, std::size_t count, const MakeShaft& shaft_of,
                          const MakeSphere& sphere_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (std::size_t i = 0; i != random_cases(shafts) && !testing::Test::HasFailure(); ++i) {
    const ShaftInput input = shaft_of(random);
    const oracle::QuickHull hull(input);
    std::vector<Sphere> spheres;
    for (std::size_t j = 0; j != count; ++j) spheres.push_back(sphere_of(random, input, hull));
    expect_exact(input, spheres);
  }
}

Sphere random(Random& random, const ShaftInput& input, const oracle::QuickHull& /*hull*/) {
  return random_sphere(random, input);
}

Sphere near_sphere(Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
  return touching_sphere(random, hull, random_centre(random, input));
}

TEST(ExactSpheres, RandomSpheresAreAnsweredExactly) { expect_exact_spheres(21, 150, 64, random_shaft, random); }

TEST(ExactSpheres, SpheresThatTouchOrNearlyTouchAreAnsweredExactly) {
  expect_exact_spheres(22, 150, 64, random_shaft, near_sphere);
}

TEST(ExactSpheres, GridAlignedSpheresAreAnsweredExactly) {
  expect_exact_spheres(
      23, 150, 64, [](Random& random) { return grid_shaft(random); },
      [](Random& random, const ShaftInput&, const oracle::QuickHull&) {
        return Sphere{{random.integer(-4, 12), random.integer(-4, 12), random.integer(-4, 12)}, random.integer(0, 6)};
      });
}

TEST(ExactSpheres, DegenerateShaftsAnswerExactly) {
  expect_exact_spheres(24, 150, 24, degenerate_shaft, near_sphere);
  expect_exact_spheres(
      25, 60, 24, degenerate_shaft, [](Random& random, const ShaftInput& of, const oracle::QuickHull&) {
        // Centres on the shaft's own corners, where every distance is 0.
        return Sphere{random.one_in(2) ? of.a.lo : of.b.hi, random.one_in(2) ? 0.0F : random.uniform(0.0F, 1.0F)};
      });
}

TEST(ExactSpheres, ShaftsFarFromTheOriginAnswerExactly) {
  for (const float distance : {1e3F, 1e4F, 1e5F, 1e7F}) {
    const auto input = [distance](Random& random) { return distant_shaft(random, distance); };
    expect_exact_spheres(26, 40, 24, input, random);
    expect_exact_spheres(27, 40, 24, input, near_sphere);
  }
}

TEST(ExactSpheres, RadiiAsSmallAsRoundingErrorsAreAnsweredExactly) {
  expect_exact_spheres(
      32, 400, 32, [](Random& random) { return long_shaft(random); }, tiny_sphere);
  expect_exact_spheres(
      33, 200, 32, [](Random& random) { return long_shaft(random, true); }, tiny_sphere);
}

TEST(ExactSpheres, SpheresOnJoiningPlanesAreAnsweredExactly) {
  // Errors without multiply-add that add up to more than a tenth of what is allowed for them, which random seldom
  // throw.
  expect_exact(
      ShaftInput{{{-0x1.3649b8p+2F, 0x1.e0a8aap+1F, -0x1.bfaep+1F}, {-0x1.188554p+2F, 0x1.617d0cp+2F, -0x1.bfaep+1F}},
                 {{0x1.06486ep-1F, 0x1.c43a78p+1F, 0x1.1afd24p+0F}, {0x1.188f08p+0F, 0x1.08c944p+2F, 0x1.c677bcp+0F}},
                 {}},
      std::vector<Sphere>{{{-0x1.4ab0f4p+3F, -0x1.d31976p+7F, 0x1.bc966p-1F}, 0x1.daa838p+7F}});
  expect_exact_spheres(34, 100, 32, random_shaft, resting_sphere);
  expect_exact_spheres(
      35, 50, 32, [](Random& random) { return long_shaft(random, true); }, resting_sphere);
}

// A distance that is less than the radius by so little that it is rounded to it, in doubles too.
TEST(ExactSpheres, ASphereAsFarFromAFaceAsItsRadiusButForADenormalIsAnsweredExactly) {
  const Box box{{0x1p-140F, -4, -4}, {4, 4, 4}};
  const Box ends_at_zero{{0, -4, -4}, {4, 4, 4}};
  const Sphere sphere{{1, 0, 0}, 1};
  expect_exact(ShaftInput{box, box}, std::vector<Sphere>{sphere});
  expect_exact(ShaftInput{ends_at_zero, ends_at_zero}, std::vector<Sphere>{sphere});
  expect_exact(ShaftInput{{{-4, -4, -4}, {-0x1p-140F, 4, 4}}, {{-4, -4, -4}, {-0x1p-140F, 4, 4}}},
               std::vector<Sphere>{{{-1, 0, 0}, 1}, {{1, 0, 0}, 1}});
}

// Whole numbers, of which exact answers need no expansions, at any magnitude that floats have.
TEST(ExactSpheres, SpheresAndPointsThatTouchOnAGridAreAnsweredExactly) {
  for (const int exponent : {-149, -130, -60, 0, 60, 121}) {
    const auto input = [exponent](Random& random) { return pythagorean_shaft(random, exponent); };
    expect_exact_spheres(38, 60, 64, input, [exponent](Random& random, const ShaftInput&, const oracle::QuickHull&) {
      return whole_sphere(random, exponent);
    });
    expect_exact_spheres(39, 60, 64, input,
                         [exponent](Random& random, const ShaftInput&, const oracle::QuickHull& hull) {
                           return whole_touching_sphere(random, hull, exponent);
                         });
  }
}

// Decimal fractions: none of them is a float, and what would touch is off by the last bits.
TEST(ExactSpheres, SpheresAndPointsOnAGridOfTenthsAreAnsweredExactly) {
  const auto tenths = [](const Box& box) {
    Box scaled = box;
    for (std::size_t k = 0; k != 3; ++k) {
      scaled.lo[k] *= 0.1F;
      scaled.hi[k] *= 0.1F;
    }
    return scaled;
  };
  const auto input = [tenths](Random& random) {
    const ShaftInput whole = pythagorean_shaft(random);
    return ShaftInput{tenths(whole.a), tenths(whole.b)};
  };
  expect_exact_spheres(40, 150, 64, input, [](Random& random, const ShaftInput&, const oracle::QuickHull&) {
    Sphere sphere = whole_sphere(random);
    for (float& x : sphere.centre) x *= 0.1F;
    sphere.radius *= 0.1F;
    return sphere;
  });
}

TEST(ExactSpheres, ShaftsOfNearlyEqualFacesAnswerExactly) {
  expect_exact_spheres(31, 100, 24, nearly_equal_shaft, near_sphere);
}

TEST(ExactSpheres, EveryMagnitudeFromDenormalsTo1e38IsAnsweredExactly) {
  for (const int exponent : {-149, -140, -126, -100, -64, 64, 100, 122}) {
    const auto wild = [exponent](Random& random) { return random.wild(exponent, exponent + 4); };
    expect_exact_spheres(
        28, 15, 24, [exponent](Random& random) { return wild_shaft(random, exponent, exponent + 4); },
        [wild](Random& random, const ShaftInput&, const oracle::QuickHull&) {
          return Sphere{{wild(random), wild(random), wild(random)}, std::abs(wild(random))};
        });
  }
  expect_exact_spheres(
      29, 120, 24, [](Random& random) { return wild_shaft(random); },
      [](Random& random, const ShaftInput&, const oracle::QuickHull&) {
        return Sphere{{random.wild(), random.wild(), random.wild()}, std::abs(random.wild())};
      });
}

// Squares of slopes overflowed, and what they should have bounded was taken for nothing: in both forms, or with rounded
// multiply-adds only.
TEST(ExactSpheres, SpheresBesideHugeShaftsAreAnsweredExactly) {
  const Box point{{0, 0x1p+73F, 0}, {0, 0x1p+73F, 0}};
  const Box end{{0x1.9fdf8cp+68F, -0x1p+73F, 0}, {0x1.9fdf8cp+68F, -0x1p+73F, 0}};
  const Sphere sphere{{-0x1.3b2c48p+59F, 0x1.ff1124p+72F, 0}, 0x1p+60F};
  expect_exact(ShaftInput{point, end, {}}, std::vector<Sphere>{sphere});
  const auto turned = [](const Vec3& v) { return Vec3{v[1], v[0], v[2]}; };
  expect_exact(ShaftInput{{turned(point.lo), turned(point.hi)}, {turned(end.lo), turned(end.hi)}, {}},
               std::vector<Sphere>{{turned(sphere.centre), sphere.radius}});
  expect_exact_spheres(37, 100, 64, huge_shaft, sphere_beside_huge);
}

TEST(ExactSpheres, SpheresOfAnySizeAroundAnOrdinaryShaftAreAnsweredExactly) {
  expect_exact_spheres(36, 60, 32, random_shaft, boundless_sphere);
}

TEST(ExactSpheres, EveryColouringOfTheFacesAnswersExactly) {
  constexpr std::uint64_t seed = 30;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (unsigned colouring = 0; colouring != colourings && !HasFailure(); ++colouring) {
    const ShaftInput input = coloured_shaft(colouring);
    const oracle::QuickHull hull(input);
    std::vector<Sphere> spheres;
    for (int i = 0; i != 8; ++i) {
      spheres.push_back({{random.integer(-2, 6), random.integer(-2, 6), random.integer(-2, 6)}, random.integer(0, 3)});
      spheres.push_back(touching_sphere(random, hull, random.vec3(-2, 6)));
    }
    expect_exact(input, spheres);
  }
}

}  // namespace
}  // namespace shaftcull
