// SPDX-License-Identifier: MIT
/// Bounds of a world in doubles, relative to an origin: what contains the true bound, and is the smallest that does, in
/// rationals.
#include "shaftcull/origin.hpp"

#include <gmock/gmock.h>
#include <gmpxx.h>

#include <algorithm>
#include <cfenv>
#include <cfloat>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

constexpr double infinite = std::numeric_limits<double>::infinity();
const Box no_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

/// Doubles with all their digits, of magnitudes that worlds have and of such as only tests have.
class RandomWorld {
 public:
  explicit RandomWorld(std::uint64_t seed) : engine_(seed), random_(seed) {}

  double number() {
    const int exponent =
        random_.one_in(4) ? static_cast<int>(random_.integer(-300, 120)) : static_cast<int>(random_.integer(-20, 40));
    return std::ldexp(std::uniform_real_distribution<double>(-1, 1)(engine_), exponent);
  }
  WorldVec3 point() { return {number(), number(), number()}; }
  /// A number near another one: the same, a float or a double next to it, or off by any amount.
  double near(double x) {
    switch (random_.below(5)) {
      case 0:
        return x;
      case 1:
        return x + 1;
      case 2:
        return std::nextafter(x, infinite);
      case 3:
        return x + double{random_.uniform(-9, 9)};
      default:
        return x + std::ldexp(number(), -30);
    }
  }
  WorldBox box_near(const WorldVec3& point) {
    WorldBox box;
    for (std::size_t k = 0; k != 3; ++k) {
      const double one = near(point[k]);
      const double other = near(point[k]);
      box.lo[k] = std::min(one, other);
      box.hi[k] = std::max(one, other);
    }
    return box;
  }
  double part() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
  Random& floats() { return random_; }

 private:
  std::mt19937_64 engine_;
  Random random_;
};

mpq_class exact(double x) { return mpq_class(x); }

/// x − y as it is.
mpq_class difference(double x, double y) { return exact(x) - exact(y); }

void expect_least_above(float found, const mpq_class& right) {
  if (found == infinity) {
    EXPECT_GT(right, exact(FLT_MAX));
    return;
  }
  EXPECT_GE(exact(found), right);
  if (found != -FLT_MAX) {
    EXPECT_LT(exact(std::nextafter(found, -infinity)), right);
  }
}

void expect_greatest_below(float found, const mpq_class& right) {
  if (found == -infinity) {
    EXPECT_LT(right, exact(-FLT_MAX));
    return;
  }
  EXPECT_LE(exact(found), right);
  if (found != FLT_MAX) {
    EXPECT_GT(exact(std::nextafter(found, infinity)), right);
  }
}

TEST(Origin, BoxesAroundAreTheSmallestAndBoxesWithinTheLargest) {
  RandomWorld world(1);
  std::size_t empties = 0;
  for (std::uint64_t i = 0; i != random_cases(4000); ++i) {
    const Origin origin(world.point());
    const WorldBox box = world.box_near(world.floats().one_in(3) ? world.point() : origin.at());
    const Box around = origin.around(box);
    const Box within = origin.within(box);
    empties += within == no_box ? 1 : 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const mpq_class lo = difference(box.lo[k], origin.at()[k]);
      const mpq_class hi = difference(box.hi[k], origin.at()[k]);
      expect_greatest_below(around.lo[k], lo);
      expect_least_above(around.hi[k], hi);
      if (within == no_box) continue;
      expect_least_above(within.lo[k], lo);
      expect_greatest_below(within.hi[k], hi);
    }
  }
  EXPECT_GT(empties, random_cases(100));
}

TEST(Origin, NoBoxOfFloatsIsWithinWhatLiesBetweenTwoFloats) {
  EXPECT_EQ(Origin().within({{0.1, 0, 0}, {0.1, 1, 1}}), no_box);
  EXPECT_EQ(Origin().within({{0.5, 0, 0}, {0.5, 1, 1}}), (Box{{0.5F, 0, 0}, {0.5F, 1, 1}}));
  EXPECT_EQ(Origin({7, 7, 7}).within({{7, 8, 9}, {9, 10, 11}}), (Box{{0, 1, 2}, {2, 3, 4}}));
}

TEST(Origin, BoxesWithoutEndAndEmptyOnesStay) {
  const Origin origin({1e6, -1e6, 5});
  const WorldBox none{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  EXPECT_EQ(origin.around(none), no_box);
  EXPECT_EQ(origin.within(none), no_box);
  const WorldBox all{{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}};
  EXPECT_EQ(origin.around(all), (Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}));
  EXPECT_EQ(origin.within(all), origin.around(all));
  const WorldBox far{{-1e300, 1e300, 5}, {1e300, 2e300, 5}};
  EXPECT_EQ(origin.around(far), (Box{{-infinity, FLT_MAX, 0}, {infinity, infinity, 0}}));
  EXPECT_EQ(origin.within(far), no_box);
}

TEST(Origin, WhatIsWrongStaysSoAndIsRefusedByWhoeverTakesIt) {
  const Origin origin({100, 100, 100});
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const WorldBox wrong{{1, 0, 0}, {0, 1, 1}};
  for (const Box& box : {origin.around(WorldBox{{0, not_a_number, 0}, {1, 1, 1}}), origin.around(wrong),
                         origin.within(WorldBox{{0, not_a_number, 0}, {1, 1, 1}}), origin.within(wrong)}) {
    EXPECT_THAT(message_of([&] { (void)BoxStream(std::vector<Box>{box}); }), HasSubstr("box 0"));
  }
  for (const WorldSphere& sphere : {WorldSphere{{0, not_a_number, 0}, 1}, WorldSphere{{0, 0, 0}, not_a_number},
                                    WorldSphere{{0, 0, 0}, -1e-300}, WorldSphere{{1e300, 0, 0}, 1}}) {
    EXPECT_THAT(message_of([&] { (void)SphereStream(std::vector<Sphere>{origin.around(sphere)}); }),
                HasSubstr("sphere 0"));
  }
  EXPECT_THAT(message_of([&] { Origin wrong_origin({0, infinite, 0}); }), HasSubstr("Origin"));
  EXPECT_THAT(message_of([&] {
                (void)Origin::for_world(WorldBox{{0, 0, 0}, {1, infinite, 1}});
              }),
              HasSubstr("lo <= hi"));
}

TEST(Origin, SpheresContainTheTrueOnesAndHardlyMore) {
  RandomWorld world(2);
  for (std::uint64_t i = 0; i != random_cases(4000); ++i) {
    const Origin origin(world.point());
    WorldSphere sphere{};
    for (std::size_t k = 0; k != 3; ++k) sphere.centre[k] = world.near(origin.at()[k]);
    sphere.radius = world.floats().one_in(5) ? 0 : std::fabs(world.number());
    const Sphere around = origin.around(sphere);
    mpq_class moved = 0;  // squared
    double about = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const mpq_class by = exact(around.centre[k]) - difference(sphere.centre[k], origin.at()[k]);
      moved += by * by;
      about += std::fabs(by.get_d());
    }
    if (around.radius == infinity) {
      EXPECT_GT(sphere.radius, 0.99 * FLT_MAX);
      continue;
    }
    const mpq_class room = exact(around.radius) - exact(sphere.radius);
    ASSERT_GE(room, 0);
    EXPECT_GE(room * room, moved);
    EXPECT_LE(around.radius, (sphere.radius + about) * (1 + 0x1p-22) + 1e-44);
  }
  EXPECT_EQ(Origin({5, 5, 5}).around(WorldSphere{{6, 7, 8}, 0.5}), (Sphere{{1, 2, 3}, 0.5F}));
}

TEST(Origin, PlanesKeepAllOfTheBoxThatTheyKept) {
  RandomWorld world(3);
  Random& random = world.floats();
  const auto corner_of = [](const WorldBox& box, unsigned i) {
    return WorldVec3{(i & 1U) != 0 ? box.hi[0] : box.lo[0], (i & 2U) != 0 ? box.hi[1] : box.lo[1],
                     (i & 4U) != 0 ? box.hi[2] : box.lo[2]};
  };
  for (std::uint64_t i = 0; i != random_cases(3000); ++i) {
    const Origin origin({1e6 * world.part(), -5e6 * world.part(), 100 * world.part()});
    WorldBox box = world.box_near(origin.at());
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = std::max(box.lo[k], origin.at()[k] - 1e4);
      box.hi[k] = std::min(box.hi[k], origin.at()[k] + 1e4);
      if (box.lo[k] > box.hi[k]) box.lo[k] = box.hi[k];
    }
    WorldPlane plane{{world.part() - 0.5, world.part() - 0.5, world.part() - 0.5}, 0};
    const bool is_of_floats = random.one_in(3);
    if (is_of_floats) plane.normal = {random.integer(-9, 9), random.uniform(-1, 1), 0};
    std::vector<WorldVec3> points;
    for (unsigned c = 0; c != 8; ++c) points.push_back(corner_of(box, c));
    for (int p = 0; p != 8; ++p) {
      WorldVec3 point{};
      for (std::size_t k = 0; k != 3; ++k)
        point[k] = std::clamp(box.lo[k] + world.part() * (box.hi[k] - box.lo[k]), box.lo[k], box.hi[k]);
      points.push_back(point);
    }
    const WorldVec3& on = points[random.below(16)];
    plane.offset = plane.normal[0] * on[0] + plane.normal[1] * on[1] + plane.normal[2] * on[2];
    const Plane found = origin.around(plane, box);
    Plane together[2];
    origin.around(std::vector<WorldPlane>{{{1, 0, 0}, 0}, plane}, box, together);
    EXPECT_EQ(together[1], found);
    for (const WorldVec3& point : points) {
      mpq_class before = 0;
      mpq_class now = 0;
      for (std::size_t k = 0; k != 3; ++k) {
        before += exact(plane.normal[k]) * exact(point[k]);
        now += exact(found.normal[k]) * difference(point[k], origin.at()[k]);
      }
      if (before <= exact(plane.offset)) {
        EXPECT_LE(now, exact(found.offset));
      }
    }
    if (!is_of_floats) continue;
    mpq_class right = exact(plane.offset);
    for (std::size_t k = 0; k != 3; ++k) right -= exact(plane.normal[k]) * exact(origin.at()[k]);
    expect_least_above(found.offset, right);
  }
}

TEST(Origin, PlanesThatFloatsCannotHoldAreRefused) {
  const Origin origin({1e6, 0, 0});
  const WorldBox box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_THAT(message_of([&] {
                (void)origin.around(WorldPlane{{1e39, 0, 0}, 1}, box);
              }),
              HasSubstr("normal beyond the largest float"));
  EXPECT_THAT(message_of([&] {
                (void)origin.around(WorldPlane{{1, 0, 0}, 1e39}, box);
              }),
              HasSubstr("farther away than the largest float"));
  EXPECT_THAT(message_of([&] {
                (void)Origin({1e300, 0, 0}).around(WorldPlane{{1e30, 0, 0}, 1}, box);
              }),
              HasSubstr("farther away than the largest float"));
  EXPECT_THAT(message_of([&] { (void)origin.around(WorldPlane{{infinite, 0, 0}, 1}, box); }), HasSubstr("not finite"));
  EXPECT_EQ(message_of([&] { (void)Origin({0, -infinite, 0}); }), "Origin: at.y = -inf is not finite");
  EXPECT_THAT(message_of([&] {
                (void)origin.around(WorldPlane{{1, 0, 0}, 1}, {{1, 0, 0}, {0, 1, 1}});
              }),
              HasSubstr("lo <= hi"));
  EXPECT_GE(origin.around(WorldPlane{{1e-300, 0, 0}, 0}, box).offset, 0);
  const std::vector<WorldPlane> planes{{{1, 0, 0}, 0}, {{1e39, 0, 0}, 1}};
  std::vector<Plane> to(2, Plane{{7, 7, 7}, 7});
  EXPECT_EQ(message_of([&] { origin.around(planes, box, to); }),
            "Origin::around: plane 1 has a normal beyond the largest float");
  EXPECT_EQ(message_of([&] { origin.around(planes, box, std::span(to).first(1)); }),
            "to has room for 1 planes, and there are 2");
  EXPECT_EQ(to, std::vector<Plane>(2, Plane{{7, 7, 7}, 7}));
}

TEST(Origin, PointsAreRoundedToNearestAndComeBack) {
  const Origin origin({4512345, 500000, 100});
  const WorldVec3 point{4512345.2, 500001.7, 99.9};
  const Vec3 near = origin.nearest(point);
  const WorldVec3 back = origin.to_world(near);
  for (std::size_t k = 0; k != 3; ++k) {
    EXPECT_EQ(near[k], static_cast<float>(point[k] - origin.at()[k]));
    EXPECT_NEAR(back[k], point[k], 1e-7);
  }
  EXPECT_EQ(origin.to_world({0, 0, 0}), origin.at());
}

// Differences that are no doubles lie beside the middle of two floats, and not on it.
TEST(Origin, PointsAreRoundedOnce) {
  const double little = 0x1p-80;
  const Vec3 above = Origin({-little, -little, -little}).nearest({1 + 0x1p-24, 1 + 0x3p-24, -1 - 0x3p-24});
  EXPECT_EQ(above, (Vec3{1 + 0x1p-23F, 1 + 0x1p-22F, -1 - 0x1p-23F}));
  const Vec3 below = Origin({little, little, little}).nearest({1 + 0x1p-24, 1 + 0x3p-24, -1 - 0x1p-24});
  EXPECT_EQ(below, (Vec3{1, 1 + 0x1p-23F, -1 - 0x1p-23F}));
}

TEST(Origin, NearIsInTheMiddleAndRound) {
  RandomWorld world(4);
  for (std::uint64_t i = 0; i != random_cases(2000); ++i) {
    const WorldBox box = world.box_near(world.point());
    const Origin origin = Origin::for_world(box);
    const double side = std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]});
    for (std::size_t k = 0; k != 3; ++k) {
      EXPECT_NEAR(origin.at()[k], box.lo[k] / 2 + box.hi[k] / 2, side / 32 + 1e-15 * std::fabs(box.hi[k]));
    }
  }
  EXPECT_EQ(Origin::for_world({{4512345.3, 500000.1, 0}, {4513345.3, 501000.1, 90}}).at(),
            (WorldVec3{4512848, 500496, 48}));
  EXPECT_EQ(Origin::for_world({{3, 4, 5}, {3, 4, 5}}).at(), (WorldVec3{3, 4, 5}));
}

TEST(Origin, ManyAreAsOneByOne) {
  RandomWorld world(5);
  const Origin origin({1e7, 1e6, 1e5});
  std::vector<WorldBox> boxes;
  std::vector<WorldSphere> spheres;
  std::vector<WorldVec3> points;
  for (int i = 0; i != 100; ++i) {
    boxes.push_back(world.box_near(origin.at()));
    spheres.push_back({boxes.back().lo, std::fabs(world.number())});
    points.push_back(boxes.back().hi);
  }
  std::vector<Box> around(100);
  std::vector<Box> within(100);
  std::vector<Sphere> spheres_around(100);
  std::vector<Vec3> nearest(100);
  origin.around(boxes, around);
  origin.within(boxes, within);
  origin.around(spheres, spheres_around);
  origin.nearest(points, nearest);
  for (std::size_t i = 0; i != 100; ++i) {
    EXPECT_EQ(around[i], origin.around(boxes[i]));
    EXPECT_EQ(within[i], origin.within(boxes[i]));
    EXPECT_EQ(spheres_around[i], origin.around(spheres[i]));
    EXPECT_EQ(nearest[i], origin.nearest(points[i]));
  }
  const std::vector<Box> before = around;
  EXPECT_THAT(message_of([&] { origin.around(std::span(boxes).first(99), around); }),
              HasSubstr("to has room for 100 boxes, and there are 99"));
  EXPECT_EQ(around, before);
  const std::span<const WorldVec3> null(static_cast<const WorldVec3*>(nullptr), 100);
  EXPECT_THAT(message_of([&] { origin.nearest(null, nearest); }), HasSubstr("points is null"));
}

// Coordinates that are multiples of the float step far away are floats relative to an origin there.
TEST(Origin, ACityInMapCoordinatesHasTheAnswersOfTheSameCityAtZero) {
  Random random(6);
  const Origin origin({4512345, 587654, 100});
  std::vector<Box> here;
  std::vector<Box> there;
  for (int i = 0; i != 500; ++i) {
    const Box box = random.grid_box(-400, 400);
    WorldBox in_the_world{};
    for (std::size_t k = 0; k != 3; ++k) {
      in_the_world.lo[k] = origin.at()[k] + 0.5 * box.lo[k];
      in_the_world.hi[k] = origin.at()[k] + 0.5 * box.hi[k];
    }
    here.push_back({{box.lo[0] / 2, box.lo[1] / 2, box.lo[2] / 2}, {box.hi[0] / 2, box.hi[1] / 2, box.hi[2] / 2}});
    there.push_back(origin.around(in_the_world));
  }
  EXPECT_EQ(here, there);
}

// A bound that is outside is outside in the world, too: of shafts from a to b, and bounds beside them by the step of a
// float. Relative to an origin nearby fewer are in question.
TEST(Origin, OutsideIsCertainInTheWorld) {
  const double away = 4512345;
  const WorldBox a{{away, away, 0}, {away + 1, away + 1, 1}};
  const WorldBox b{{away + 9, away, 0}, {away + 10, away + 1, 1}};
  const WorldBox wall{{away + 4, away + 1.2, 0}, {away + 5, away + 1.4, 3}};
  const Origin near = Origin::for_world({{away, away, 0}, {away + 10, away + 2, 3}});
  EXPECT_FALSE(keeps(compile(near.around(a), near.around(b)), near.around(wall)));
  const Origin zero;
  EXPECT_TRUE(
      keeps(compile(zero.around(a), zero.around(b)), zero.around(wall)));  // 0.2 is less than half a step of 0.5
}

}  // namespace
}  // namespace shaftcull
