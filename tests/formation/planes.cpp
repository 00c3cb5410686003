// SPDX-License-Identifier: MIT
/// Joining planes: against the reference answers, of random shafts, and at the ends of the float range.
#include <gmock/gmock.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <vector>

#include "compiled/shaft_data.hpp"
#include "golden.hpp"
#include "oracle/random.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull {
namespace {

double distance_between(const Plane& p, const Plane& q) {
  double most = std::fabs(double{p.offset} - double{q.offset}) / std::max(1.0, std::fabs(double{q.offset}));
  for (std::size_t k = 0; k != 3; ++k) most = std::max(most, std::fabs(double{p.normal[k]} - double{q.normal[k]}));
  return most;
}

/// The same plane with a unit normal.
Plane unit(const Plane& plane) {
  const double length = std::hypot(double{plane.normal[0]}, double{plane.normal[1]}, double{plane.normal[2]});
  const auto scaled = [&](float x) { return static_cast<float>(x / length); };
  return {{scaled(plane.normal[0]), scaled(plane.normal[1]), scaled(plane.normal[2])}, scaled(plane.offset)};
}

TEST(JoiningPlanes, AreThoseOfTheReferenceAnswers) {
  const std::vector<golden::ShaftRow> shafts = golden::load_shafts();
  std::vector<std::vector<Plane>> expected(shafts.size());
  for (const golden::PlaneRow& row : golden::load_planes()) expected[row.shaft].push_back(row.plane);
  for (const golden::ShaftRow& row : shafts) {
    for (const Formation formation : {Formation::search, Formation::table64, Formation::table729}) {
      const Shaft shaft(row.a, row.b, {.formation = formation});
      ASSERT_EQ(shaft.joining_planes().size(), row.plane_count) << "shaft " << row.shaft;
      for (const Plane& plane : expected[row.shaft]) {
        double nearest = INFINITY;
        for (const JoiningPlane& own : shaft.joining_planes()) {
          nearest = std::min(nearest, distance_between(unit(own.plane), plane));
        }
        EXPECT_LT(nearest, 1e-5) << "shaft " << row.shaft;
      }
    }
  }
}

TEST(JoiningPlanes, OfBoxesBetweenRandomPointsAreAsManyAsChanceSays) {
  // On an axis four random numbers nest with probability 1/3; the shares follow by counting.
  constexpr std::uint64_t seed = 2000;
  constexpr std::size_t shafts = 20000;
  Random random(seed);
  std::array<double, 9> share{};
  double mean = 0;
  for (std::size_t i = 0; i != shafts; ++i) {
    const auto box = [&] { return Random::sorted(random.vec3(-5, 5), random.vec3(-5, 5)); };
    const Box a = box();
    const Box b = box();
    const std::size_t planes = Shaft(a, b).joining_planes().size();
    share[planes] += 1.0 / shafts;
    mean += static_cast<double>(planes) / shafts;
  }
  EXPECT_NEAR(share[0], 0.01, 0.005) << "seed " << seed;
  EXPECT_NEAR(share[4], 0.11, 0.01) << "seed " << seed;
  EXPECT_NEAR(share[6], 0.74, 0.015) << "seed " << seed;
  EXPECT_NEAR(share[8], 0.14, 0.015) << "seed " << seed;
  EXPECT_NEAR(share[0] + share[4] + share[6] + share[8], 1, 1e-9) << "seed " << seed;
  EXPECT_NEAR(mean, 6, 0.05) << "seed " << seed;
}

TEST(JoiningPlanes, OfCompiledShaftsHaveUnitNormals) {
  Random random(7);
  for (int i = 0; i != 1000; ++i) {
    const CompiledShaft compiled = compile(Shaft(random.box(-5, 5, 0.1F, 2), random.box(-5, 5, 0.1F, 2)));
    const kernel::ShaftData& shaft = kernel::data_of(compiled);
    for (std::size_t p = 0; p != shaft.joining_count; ++p) {
      EXPECT_NEAR(std::hypot(shaft.joining_normal0[p], shaft.joining_normal1[p]), 1, 1e-6) << "seed 7, shaft " << i;
    }
  }
}

TEST(JoiningPlanes, AreFiniteForAllFiniteBoxes) {
  Random random(11);
  for (int i = 0; i != 20000; ++i) {
    const auto wild = [&] { return Vec3{random.wild(), random.wild(), random.wild()}; };
    const auto huge = [&] {
      const auto far = [&] { return random.one_in(2) ? FLT_MAX : -FLT_MAX * random.uniform(0, 1); };
      return Vec3{far(), far(), far()};
    };
    const Box a = i % 2 == 0 ? Random::sorted(wild(), wild()) : Random::sorted(huge(), huge());
    const Box b = i % 2 == 0 ? Random::sorted(wild(), wild()) : Random::sorted(huge(), huge());
    const std::string where = "seed 11, shaft " + std::to_string(i);
    const Shaft shaft(a, b);
    for (const JoiningPlane& joining : shaft.joining_planes()) {
      const Vec3& n = joining.plane.normal;
      EXPECT_TRUE(std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2])) << where;
      EXPECT_TRUE(std::isfinite(joining.plane.offset)) << where;
      EXPECT_FALSE(n[0] == 0 && n[1] == 0 && n[2] == 0) << where;
    }
    const CompiledShaft compiled = compile(shaft);
    const kernel::ShaftData& data = kernel::data_of(compiled);
    for (std::size_t p = 0; p != data.joining_count; ++p) {
      EXPECT_TRUE(std::isfinite(data.joining_normal0[p]) && std::isfinite(data.joining_normal1[p])) << where;
      EXPECT_TRUE(std::isfinite(data.joining_minus_offset[p])) << where;
      EXPECT_FALSE(data.joining_normal0[p] == 0 && data.joining_normal1[p] == 0) << where;
    }
  }
}

TEST(JoiningPlanes, OfDenormalBoxesAreThoseOfTheSameBoxesMagnified) {
  const Box a{{0, 0, 0}, {8, 8, 8}};
  const Box b{{-8, -8, -8}, {-4, -4, -4}};
  const auto scaled = [](Box box) {
    for (float& x : box.lo) x *= 0x1p-149F;
    for (float& x : box.hi) x *= 0x1p-149F;
    return box;
  };
  const Shaft large(a, b);
  const Shaft small(scaled(a), scaled(b));
  ASSERT_EQ(small.joining_planes().size(), large.joining_planes().size());
  for (std::size_t i = 0; i != large.joining_planes().size(); ++i) {
    const Plane right = unit(large.joining_planes()[i].plane);
    EXPECT_LT(distance_between(unit(small.joining_planes()[i].plane), {right.normal, right.offset * 0x1p-149F}), 1e-6);
  }
}

}  // namespace
}  // namespace shaftcull
