// SPDX-License-Identifier: MIT
/// Convex polygons that block a shaft, and hulls of points as its ends: answers equal those of exact arithmetic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "exact/blocking.hpp"
#include "exact/polygon.hpp"
#include "message_of.hpp"
#include "oracle/blocking.hpp"
#include "oracle/cases/families.hpp"
#include "sanitizers.hpp"
#include "shaftcull/occluded.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

/// A convex polygon in one plane, with integer corners: a triangle, a parallelogram or a pentagon, either way round.
std::vector<Vec3> lattice_polygon(Random& random) {
  const auto any = [&](int reach) {
    return Vec3{random.integer(-reach, reach), random.integer(-reach, reach), random.integer(-reach, reach)};
  };
  const Vec3 origin = any(6);
  const Vec3 u = any(9);
  const Vec3 v = any(9);
  const float size = random.integer(1, 4);
  const auto at = [&](float i, float j) {
    Vec3 corner{};
    for (std::size_t k = 0; k != 3; ++k) corner[k] = origin[k] + size * (i * u[k] + j * v[k]);
    return corner;
  };
  std::vector<Vec3> polygon;
  switch (random.below(3)) {
    case 0:
      polygon = {at(-1, -1), at(3, -1), at(-1, 3)};
      break;
    case 1:
      polygon = {at(-1, -1), at(2, -1), at(2, 2), at(-1, 2)};
      break;
    default:
      polygon = {at(-1, -1), at(2, -1), at(3, 1), at(2, 3), at(-1, 3)};
      break;
  }
  if (random.one_in(2)) std::reverse(polygon.begin(), polygon.end());
  if (random.one_in(4)) polygon.push_back(polygon.back());
  return polygon;
}

TEST(Occluded, PolygonsAreAnsweredExactly) {
  constexpr std::uint64_t seed = 741;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t blocking = 0;
  for (std::size_t i = 0; i != random_cases(4000); ++i) {
    ShaftInput input{random.grid_box(0, 3), random.grid_box(0, 3)};
    const std::size_t axis = random.below(3);
    const float apart = random.integer(0, 8);
    input.b.lo[axis] += apart;
    input.b.hi[axis] += apart;
    const std::vector<Vec3> polygon = lattice_polygon(random);
    const bool right = oracle::blocks(input.a, input.b, polygon, 1);
    ASSERT_EQ(occluded(compile(input.a, input.b), polygon), right)
        << source_text(input) << "\n  " << testing::PrintToString(polygon);
    if (!right) continue;
    ++blocking;
    EXPECT_TRUE(oracle::blocks(input.a, input.b, polygon, 2)) << "corners do not decide";
  }
  EXPECT_GE(blocking, random_cases(100));
}

/// A small box on a grid, which is flat on some axes more often than not.
Box flat_grid_box(Random& random) {
  Box box = random.grid_box(0, 3);
  for (std::size_t k = 0; k != 3; ++k) {
    if (random.one_in(2)) box.hi[k] = box.lo[k];
  }
  return box;
}

/// An end by its corners: a convex polygon, a point, or a small box.
std::vector<Vec3> lattice_end(Random& random) {
  if (random.one_in(2)) return lattice_polygon(random);
  const Box box = flat_grid_box(random);
  const kernel::BoxCorners corners({box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]});
  return {corners.get().begin(), corners.get().end()};
}

TEST(Occluded, HullsOfPointsAsEndsAreAnsweredExactly) {
  constexpr std::uint64_t seed = 743;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t blocking = 0;
  for (std::size_t i = 0; i != random_cases(6000); ++i) {
    std::vector<Vec3> a = lattice_end(random);
    std::vector<Vec3> b = lattice_end(random);
    const std::size_t axis = random.below(3);
    const float apart = random.integer(0, 60);
    for (Vec3& corner : b) corner[axis] += apart;
    // Around the middle, with faces that end flush with the ends in places.
    Box box{};
    for (std::size_t k = 0; k != 3; ++k) {
      const auto less = [k](const Vec3& p, const Vec3& q) { return p[k] < q[k]; };
      const auto [least_of_a, largest_of_a] = std::minmax_element(a.begin(), a.end(), less);
      const auto [least_of_b, largest_of_b] = std::minmax_element(b.begin(), b.end(), less);
      box.lo[k] = random.one_in(2) ? (*least_of_a)[k] : (*least_of_b)[k];
      box.hi[k] = random.one_in(2) ? (*largest_of_a)[k] : (*largest_of_b)[k];
      if (random.one_in(4)) box.lo[k] -= random.integer(-1, 9);
      if (random.one_in(4)) box.hi[k] += random.integer(-1, 9);
      if (k == axis && !random.one_in(4)) {
        box.lo[k] = (*largest_of_a)[k] + random.integer(0, 2);
        box.hi[k] = random.one_in(3) ? box.lo[k] : (*least_of_b)[k] - random.integer(0, 2);
      }
      if (box.hi[k] < box.lo[k]) std::swap(box.lo[k], box.hi[k]);
    }
    const float bound[6] = {box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]};
    const bool right = oracle::blocks(a, b, box);
    blocking += right ? 1U : 0U;
    ASSERT_EQ(kernel::box_blocks(a, b, bound), right)
        << testing::PrintToString(a) << "\n  " << testing::PrintToString(b) << "\n  " << source_text(box);
  }
  EXPECT_GE(blocking, random_cases(200));
}

TEST(Occluded, PolygonsBetweenHullsOfPointsAreAnsweredExactly) {
  constexpr std::uint64_t seed = 744;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t blocking = 0;
  for (std::size_t i = 0; i != random_cases(6000); ++i) {
    std::vector<Vec3> a = lattice_end(random);
    std::vector<Vec3> b = lattice_end(random);
    std::vector<Vec3> polygon = lattice_polygon(random);
    const std::size_t axis = random.below(3);
    if (random.one_in(2)) {  // a rectangle that ends flush with the ends in places
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      const Vec3 lo = a[random.below(static_cast<unsigned>(a.size()))];
      const Vec3 hi = b[random.below(static_cast<unsigned>(b.size()))];
      if (lo[u] == hi[u] || lo[v] == hi[v]) continue;
      polygon.assign(4, lo);
      polygon[1][u] = polygon[2][u] = hi[u];
      polygon[2][v] = polygon[3][v] = hi[v];
    }
    const float apart = random.integer(0, 60);
    for (Vec3& corner : a) corner[axis] -= apart;
    for (Vec3& corner : b) corner[axis] += apart;
    const bool right = oracle::blocks(a, b, polygon);
    blocking += right ? 1U : 0U;
    ASSERT_EQ(kernel::polygon_blocks(a, b, polygon), right)
        << testing::PrintToString(a) << "\n  " << testing::PrintToString(b) << "\n  "
        << testing::PrintToString(polygon);
  }
  EXPECT_GE(blocking, random_cases(100));
}

TEST(Occluded, CornersOfABoxAnswerAsTheBoxDoes) {
  constexpr std::uint64_t seed = 745;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (std::size_t i = 0; i != random_cases(60000); ++i) {
    const bool is_on_grid = !random.one_in(3);
    const ShaftInput input =
        is_on_grid ? ShaftInput{flat_grid_box(random), flat_grid_box(random)} : random_shaft(random);
    const Box box = is_on_grid ? random.grid_box(-1, 4) : blocking_box(random, input);
    const float bound[6] = {box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]};
    const CompiledShaft compiled = compile(input.a, input.b);
    const kernel::ShaftData& shaft = kernel::data_of(compiled);
    ASSERT_EQ(kernel::box_blocks(kernel::BoxCorners(shaft.a).get(), kernel::BoxCorners(shaft.b).get(), bound),
              kernel::box_blocks(shaft, bound))
        << source_text(input) << "\n  " << source_text(box);
  }
}

TEST(Occluded, AFlatBoxBlocksAsThePolygonOfItsCornersDoes) {
  Random random(742);
  std::size_t blocking = 0;
  for (std::size_t i = 0; i != random_cases(3000); ++i) {
    ShaftInput input = random_shaft(random);
    Box box = blocking_box(random, input);
    const std::size_t axis = random.below(3);
    box.hi[axis] = box.lo[axis];
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    std::vector<Vec3> polygon(4, box.lo);
    polygon[1][u] = polygon[2][u] = box.hi[u];
    polygon[2][v] = polygon[3][v] = box.hi[v];
    if (polygon[0] == polygon[1] || polygon[1] == polygon[2]) continue;
    const bool right = occluded(compile(input.a, input.b), box);
    blocking += right ? 1U : 0U;
    EXPECT_EQ(occluded(compile(input.a, input.b), polygon), right) << source_text(input) << "\n  " << source_text(box);
  }
  EXPECT_GE(blocking, random_cases(20));
}

TEST(Occluded, APolygonThatIsBentBlocksWhatPassesAllOfItsTriangles) {
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 0}}, Box{{0, 0, 5}, {1, 1, 5}});
  std::vector<Vec3> roof = {{-9, -9, 2}, {9, -9, 2.1F}, {9, 9, 2}, {-9, 9, 1.9F}};
  EXPECT_TRUE(occluded(shaft, roof));
  roof[1][2] = 40;  // the plane of its first triangle does not part the ends
  EXPECT_FALSE(occluded(shaft, roof));
}

TEST(Occluded, WhatIsNoPolygonIsRefused) {
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 0}}, Box{{0, 0, 5}, {1, 1, 5}});
  std::vector<Vec3> polygon = {{-9, -9, 2}, {9, -9, 2}};
  EXPECT_THAT(message_of([&] { (void)occluded(shaft, polygon); }), testing::HasSubstr("polygon has 2 corners"));
  polygon.push_back({0, infinity, 2});
  EXPECT_THAT(message_of([&] { (void)occluded(shaft, polygon); }), testing::HasSubstr("polygon[2] is not finite"));
}

}  // namespace
}  // namespace shaftcull
