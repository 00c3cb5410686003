// SPDX-License-Identifier: MIT
/// Normals of contact: through which face a box is reached, and in which direction a sphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/entry_time.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/volumes.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

/// Of one bound, in a view and in a tree.
template <class Bound>
Vec3 normal(const CompiledShaft& shaft, const Bound& bound, const Query& query = {}) {
  const std::vector<Bound> one{bound};
  const FirstContact contact = first_contact(shaft, columns(one).view(), query);
  EXPECT_TRUE(contact) << source_text(bound);
  if constexpr (std::is_same_v<Bound, Box>) {
    if (std::isfinite(bound.lo[0] + bound.lo[1])) {
      EXPECT_EQ(first_contact(shaft, BoxTree(one), query), contact);
    }
  }
  return contact.normal;
}

/// Of length 1, but for rounding.
void expect_unit(const Vec3& normal) {
  double square = 0;
  for (const float n : normal) square += static_cast<double>(n) * n;
  EXPECT_NEAR(square, 1, 0x1p-22);
}

const Box cube{{-1, -1, -1}, {1, 1, 1}};

TEST(ContactNormal, OfABoxIsThatOfTheFacesThatMeetLast) {
  on_each_instruction_set([] {
    EXPECT_EQ(normal(swept(cube, {8, 0, 0}), Box{{4, -1, -1}, {5, 1, 1}}), (Vec3{-1, 0, 0}));
    EXPECT_EQ(normal(swept(cube, {-8, 0, 0}), Box{{-5, -1, -1}, {-4, 1, 1}}), (Vec3{1, 0, 0}));
    EXPECT_EQ(normal(swept(cube, {0, 8, 0}), Box{{-1, 4, -1}, {1, 5, 1}}), (Vec3{0, -1, 0}));
    EXPECT_EQ(normal(swept(cube, {0, -8, 0}), Box{{-1, -5, -1}, {1, -4, 1}}), (Vec3{0, 1, 0}));
    EXPECT_EQ(normal(swept_infinite(cube, {0, 0, 8}), Box{{-1, -1, 4}, {1, 1, 5}}), (Vec3{0, 0, -1}));
    EXPECT_EQ(normal(swept_infinite(cube, {0, 0, -8}), Box{{-1, -1, -5}, {1, 1, -4}}), (Vec3{0, 0, 1}));
    // It passes the box on x at 1/8, and reaches it on y at 1/4.
    EXPECT_EQ(normal(swept(cube, {8, 8, 0}), Box{{2, 3, -1}, {9, 9, 1}}), (Vec3{0, -1, 0}));
    // A face that moves outwards while the other one stays.
    EXPECT_EQ(normal(compile(cube, {{-1, -1, -1}, {1, 1, 9}}), Box{{-1, -1, 4}, {1, 1, 5}}), (Vec3{0, 0, -1}));
  });
}

TEST(ContactNormal, AtAnEdgeOrACornerIsAlongTheLowestAxis) {
  on_each_instruction_set([] {
    const Box corner{{3, 3, 3}, {9, 9, 9}};
    EXPECT_EQ(normal(swept(cube, {8, 8, 8}), corner), (Vec3{-1, 0, 0}));
    EXPECT_EQ(normal(swept({{-1, -1, 2}, {1, 1, 4}}, {4, 4, 4}), corner), (Vec3{-1, 0, 0}));
    EXPECT_EQ(normal(swept({{2, -1, -1}, {4, 1, 1}}, {4, 4, 4}), corner), (Vec3{0, -1, 0}));
    // The face on lo y comes before the one on hi x in the order of faces.
    EXPECT_EQ(normal(swept(cube, {8, -8, 0}), Box{{3, -9, -1}, {9, -3, 1}}), (Vec3{-1, 0, 0}));
  });
}

TEST(ContactNormal, IsZeroUnlessTheBoxMovesIntoTheBound) {
  on_each_instruction_set([] {
    const CompiledShaft shaft = swept(cube, {8, 0, 0});
    EXPECT_EQ(normal(shaft, Box{{0, 0, 0}, {5, 5, 5}}), Vec3{}) << "overlaps";
    EXPECT_EQ(normal(shaft, Box{{-9, -2, -9}, {9, -1, 9}}), Vec3{}) << "a floor along which it moves";
    EXPECT_EQ(normal(shaft, Box{{-2, -1, -1}, {-1, 1, 1}}), Vec3{}) << "what it leaves behind";
    EXPECT_EQ(normal(shaft, Box{{1, -1, -1}, {2, 1, 1}}), (Vec3{-1, 0, 0})) << "what it touches and moves into";
    EXPECT_EQ(normal(swept(cube, {8, -8, 0}), Box{{-9, -2, -9}, {9, -1, 9}}), (Vec3{0, 1, 0})) << "a floor";
    EXPECT_EQ(normal(shadow({{-5, -2, -2}, {-4, 2, 2}}, cube, 1), Box{{1, -1, -1}, {2, 1, 1}}), Vec3{}) << "still";
    EXPECT_EQ(normal(shaft, Sphere{{2, 0, 0}, 1.5F}), Vec3{}) << "overlaps";
    EXPECT_EQ(normal(shaft, Sphere{{0, 2, 0}, 1}), Vec3{}) << "touched in passing";
    EXPECT_EQ(normal(shaft, Sphere{{-2, 0, 0}, 1}), Vec3{}) << "left behind";
    EXPECT_EQ(normal(shaft, Sphere{{2, 0, 0}, 1}), (Vec3{-1, 0, 0})) << "touched and moved into";
    EXPECT_EQ(normal(shaft, Sphere{{4, 5, 0}, 5}), (Vec3{-0.6F, -0.8F, 0})) << "touched at an edge and moved into";
    EXPECT_EQ(normal(shaft, Sphere{{-4, 5, 0}, 5}), Vec3{}) << "touched at an edge and left behind";
    EXPECT_EQ(first_contact(shaft, BoxView()).normal, Vec3{}) << "nothing";
  });
}

TEST(ContactNormal, OfASpherePointsFromItsCentreToTheNearestPoint) {
  on_each_instruction_set([] {
    const CompiledShaft shaft = swept(cube, {16, 0, 0});
    EXPECT_EQ(normal(shaft, Sphere{{8, 0.5F, 0}, 3}), (Vec3{-1, 0, 0}));
    EXPECT_EQ(normal(shaft, Sphere{{8, 5, 0}, 5}), (Vec3{-0.6F, -0.8F, 0}));
    EXPECT_EQ(normal(shaft, Sphere{{8, 0, -4}, 5}), (Vec3{-0.8F, 0, 0.6F}));
    EXPECT_EQ(normal(shaft, Sphere{{8, 3, 7}, 7}), (Vec3{-3 / 7.0F, -2 / 7.0F, -6 / 7.0F}));
    EXPECT_EQ(normal(shaft, Sphere{{8, 4, 0}, 3}), (Vec3{0, -1, 0})) << "touched in passing";
    EXPECT_EQ(normal(swept(cube, {8, 8, 8}), Sphere{{5, 5, 5}, 0}), (Vec3{-1, 0, 0})) << "a point: the lowest axis";
    EXPECT_EQ(normal(swept(cube, {0, 8, 8}), Sphere{{0, 5, 5}, 0}), (Vec3{0, -1, 0})) << "a point";
    EXPECT_EQ(normal(shaft, Sphere{{1, 0, 0}, 0}), (Vec3{-1, 0, 0})) << "a point that is touched";
    EXPECT_EQ(normal(shaft, Sphere{{0, 0, 0}, 0}), Vec3{}) << "a point within";
  });
}

TEST(ContactNormal, TakesNoConstraintFromWhatIsNotFinite) {
  const CompiledShaft shaft = swept(cube, {8, 0, 0});
  EXPECT_EQ(normal(shaft, Box{{3, -infinity, nan}, {infinity, infinity, nan}}), (Vec3{-1, 0, 0}));
  EXPECT_EQ(normal(shaft, Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}), Vec3{});
  EXPECT_EQ(normal(shaft, Sphere{{30, 30, 30}, infinity}), Vec3{});
  EXPECT_EQ(normal(shaft, Sphere{{30, 30, 30}, nan}), Vec3{});
  EXPECT_EQ(normal(shaft, Sphere{{5, nan, 0}, 2}), (Vec3{-1, 0, 0}));
}

/// A box whose edge comes a known way beside the centre, so that a component is known: (2²⁴ + `ulps`) / 2²⁵.
float component_beside(float ulps) {
  const CompiledShaft shaft = swept(Box{{0, 0x1p24F, 0}, {1, 0x1p25F, 1}}, {0x1p30F, 0, 0});
  return normal(shaft, Sphere{{0x1p28F, -ulps, 0.5F}, 0x1p25F})[1];
}

TEST(ContactNormal, IsRoundedToNearestAndToEvenWhereTwoAreAsNear) {
  EXPECT_EQ(component_beside(0), 0.5F);
  EXPECT_EQ(component_beside(1), 0.5F);
  EXPECT_EQ(component_beside(0x1.000002p0F), 0.5F + 0x1p-24F);
  EXPECT_EQ(component_beside(0x1.fffffep-1F), 0.5F);
  EXPECT_EQ(component_beside(2), 0.5F + 0x1p-24F);
  EXPECT_EQ(component_beside(3), 0.5F + 0x1p-23F);
  EXPECT_EQ(component_beside(0x1.7ffffep1F), 0.5F + 0x1p-24F);
}

/// Returns whether there is a contact with a normal along no axis.
bool expect_exact(const MovingInput& input, const Sphere& sphere) {
  if (!oracle::entry_time(input, sphere)) return false;
  const Vec3 expected = oracle::contact_normal(input, sphere);
  const Vec3 found = normal(shaft_of(input), sphere);
  EXPECT_EQ(found, expected) << source_text(input) << "; " << source_text(sphere);
  if (expected != Vec3{}) expect_unit(found);
  return std::ranges::count(found, 0.0F) < 2;
}

TEST(ContactNormal, OfSpheresThatAreGrazedIsExact) {
  std::size_t oblique = 0;
  Random random(830);
  for (std::size_t i = 0; i != random_cases(2000) && !testing::Test::HasFailure(); ++i) {
    // The centre is as far beside an edge or a corner as the radius, to a few units in the last place.
    const float r = random.uniform(0.1F, 9);
    const float y = random.one_in(2) ? 0.6F * r : 0.0F;
    const float z = y == 0 ? r : 0.8F * r;
    const float x = random.uniform(-0x1p10F, 0x1p10F);
    oblique += expect_exact(
        {MovingInput::Kind::swept_infinite, {{-0x1p12F, -1, -1}, {-0x1p11F, 0, 0}}, {random.uniform(1, 9), 0, 0}},
        {{x, random.nudge(y), random.nudge(z)}, r});
  }
  EXPECT_GT(oblique, 0U) << "the cases are too easy";
}

TEST(ContactNormal, OfTinySpheresFarAwayIsExact) {
  std::size_t oblique = 0;
  Random random(831);
  for (std::size_t i = 0; i != random_cases(2000) && !testing::Test::HasFailure(); ++i) {
    const float r = std::ldexp(random.uniform(0.5F, 1), -static_cast<int>(random.below(120)));
    const auto near_corner = [&] { return random.uniform(-1, 2) * r; };
    // Each axis moves as far as it is away, so that the corner comes by.
    const float far = std::ldexp(1.0F, static_cast<int>(random.below(20)));
    const Vec3 way{far, random.one_in(3) ? 0 : far * 2, random.one_in(3) ? 0 : far * 3};
    oblique += expect_exact(
        {MovingInput::Kind::swept_infinite, {{-0x1p24F, -0x1p24F, -0x1p24F}, {-way[0], -way[1], -way[2]}}, way},
        {{near_corner(), near_corner(), near_corner()}, r});
  }
  EXPECT_GT(oblique, 0U) << "the cases are too easy";
}

TEST(ContactNormal, OfSpheresOfAllSizesIsExact) {
  std::size_t oblique = 0;
  Random random(832);
  for (std::size_t i = 0; i != random_cases(2000) && !testing::Test::HasFailure(); ++i) {
    const auto wild = [&] { return std::ldexp(random.uniform(-1, 1), static_cast<int>(random.below(200)) - 100); };
    const Box box = Random::sorted({wild(), wild(), wild()}, {wild(), wild(), wild()});
    const MovingInput input{MovingInput::Kind::swept_infinite, box, {wild(), wild(), wild()}};
    for (int n = 0; n != 8; ++n) {
      const float r = std::fabs(wild());
      Sphere sphere{{wild(), wild(), wild()}, r};
      // Some touch the start, or nearly.
      if (random.one_in(3)) sphere.centre[0] = box.hi[0] + r;
      if (keeps(shaft_of(input), sphere)) oblique += expect_exact(input, sphere);
    }
  }
  EXPECT_GT(oblique, 0U) << "the cases are too easy";
}

}  // namespace
}  // namespace shaftcull
