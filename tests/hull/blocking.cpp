// SPDX-License-Identifier: MIT
/// Hulls between two ends, and solids that hide these from each other: against the oracle, in views, trees and alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/blocking.hpp"
#include "oracle/cases/ends.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/tree.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

using Points = std::vector<Vec3>;

TEST(HullBlocking, BoxesBlockIfAllSegmentsBetweenCornersPassThroughThem) {
  std::size_t blocked = 0;
  std::size_t all = 0;
  Random random(1);
  for (std::uint64_t i = 0; i != random_cases(120); ++i) {
    const bool on_grid = random.one_in(2);
    const Ends ends = random_ends(random, on_grid);
    const ConvexHull hull =
        between_polygons(ends.p, ends.q, random.one_in(2) ? HullTest::exact : HullTest::conservative);
    std::vector<Box> boxes;
    while (boxes.size() != 100 + i % 3) boxes.push_back(random_wall(random, on_grid));
    boxes[7] = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    boxes[8] = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    boxes[9] = {{0, nan, -9}, {1, 9, 9}};
    std::vector<std::uint32_t> right;
    for (std::uint32_t b = 0; b != boxes.size(); ++b) {
      if (b != 9 && oracle::blocks(ends.p, ends.q, boxes[b])) right.push_back(b);
    }
    blocked += right.size();
    all += boxes.size();
    const BoxColumns memory(boxes);
    std::vector<Box> finite = boxes;
    for (const std::size_t at : {7U, 8U, 9U}) finite[at] = {{50, 50, 50}, {51, 51, 51}};
    const BoxTree tree{std::span<const Box>(finite)};
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      std::vector<std::uint32_t> listed(boxes.size());
      listed.resize(list_occluders(hull, memory.view(), listed));
      ASSERT_EQ(listed, right) << "on " << name(isa) << ", case " << i;
      EXPECT_EQ(occluded(hull, memory.view()), !right.empty());
      EXPECT_EQ(find_occluder(hull, memory.view()), right.empty() ? std::optional<std::uint32_t>() : right[0]);
      listed.resize(boxes.size());
      listed.resize(list_occluders(hull, tree, listed));
      std::sort(listed.begin(), listed.end());
      std::vector<std::uint32_t> of_tree = right;
      std::erase(of_tree, 7U);
      ASSERT_EQ(listed, of_tree) << "in a tree on " << name(isa) << ", case " << i;
      EXPECT_EQ(find_occluder(hull, tree).has_value(), !of_tree.empty());
      const CompiledShaft two[] = {hull.compiled(), compile({{0, 0, 0}, {0, 0, 0}}, {{90, 90, 90}, {91, 91, 91}})};
      std::uint64_t bits = 0;
      occluded_many(two, tree, {&bits, 1});
      EXPECT_EQ(bits & 1U, of_tree.empty() ? 0U : 1U);
    }
    for (std::uint32_t b = 0; b != boxes.size(); ++b) {
      ASSERT_EQ(occluded(hull, boxes[b]), std::find(right.begin(), right.end(), b) != right.end()) << b;
    }
  }
  EXPECT_GT(blocked * 20, all) << "too few block";
}

TEST(HullBlocking, PolygonsBlockAsTheirDefinitionSays) {
  std::size_t blocked = 0;
  Random random(2);
  for (std::uint64_t i = 0; i != random_cases(600); ++i) {
    const Ends ends = random_ends(random, random.one_in(2));
    const ConvexHull hull = between_polygons(ends.p, ends.q);
    const float x = random.integer(-5, 5);
    const float lean = random.integer(-1, 1);
    Points wall;
    for (const auto& [y, z] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
      const float size = random.integer(1, 5);
      wall.push_back({x + lean * y * size, y * size, z * size});
    }
    wall.resize(3 + random.below(2));
    const bool is_flat = wall.size() == 3 || lean == 0;
    if (!is_flat) wall.resize(3);
    const bool right = oracle::blocks(ends.p, ends.q, wall);
    ASSERT_EQ(occluded(hull, wall), right) << "case " << i;
    blocked += right ? 1 : 0;
  }
  EXPECT_GT(blocked * 20, random_cases(600));
}

TEST(HullBlocking, TheCornersOfTwoBoxesAnswerAsTheShaftBetweenThem) {
  Random random(3);
  for (std::uint64_t i = 0; i != random_cases(100); ++i) {
    Box box[2];
    Points corners[2];
    for (unsigned e = 0; e != 2; ++e) {
      box[e] = random.grid_box(-2, 2);
      for (std::size_t k = 0; k != 1; ++k) {
        box[e].lo[k] += e == 0 ? -5.0F : 5.0F;
        box[e].hi[k] += e == 0 ? -5.0F : 5.0F;
      }
      for (unsigned c = 0; c != 8; ++c) {
        Vec3 corner{};
        for (std::size_t k = 0; k != 3; ++k) corner[k] = (c >> k & 1U) != 0 ? box[e].hi[k] : box[e].lo[k];
        corners[e].push_back(corner);
      }
    }
    const ConvexHull hull = between_polygons(corners[0], corners[1]);
    const CompiledShaft shaft = compile(box[0], box[1]);
    for (unsigned b = 0; b != 60; ++b) {
      const Box wall = random_wall(random, true);
      ASSERT_EQ(occluded(hull, wall), occluded(shaft, wall)) << source_text(wall);
    }
  }
}

TEST(HullBlocking, CopiesAndMovesKeepTheirEnds) {
  const Points p = {{0, 0, 0}, {0, 2, 0}, {0, 2, 2}};
  const Points q = {{9, 0, 0}, {9, 2, 0}, {9, 2, 2}};
  const Box wall{{4, -9, -9}, {5, 9, 9}};
  std::optional<ConvexHull> hull(between_polygons(p, q));
  const ConvexHull copy = *hull;
  ConvexHull moved = std::move(*hull);
  hull.reset();
  EXPECT_TRUE(occluded(copy, wall));
  EXPECT_TRUE(occluded(moved, wall));
  EXPECT_EQ(find_occluder(copy, BoxStream(std::vector<Box>{wall})), 0U);
  CompiledShaft open = copy;
  set_contact(open, Contact::open);
  EXPECT_TRUE(occluded(open, wall));
  EXPECT_EQ(moved.points().size(), 6U);
  moved = ConvexHull(p);
  EXPECT_THAT(message_of([&] { static_cast<void>(occluded(moved, wall)); }), HasSubstr("between_polygons()"));
}

TEST(HullBlocking, HullsOfOneSetOfPointsAreRefused) {
  const ConvexHull hull(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Box wall{{4, -9, -9}, {5, 9, 9}};
  const BoxStream walls(std::vector<Box>{wall});
  std::vector<std::uint32_t> listed(1);
  const auto refusal =
      "shaft 0 is a hull of one set of points, and is asked what blocks it; form it by between_polygons()";
  EXPECT_THAT(message_of([&] { static_cast<void>(occluded(hull, wall)); }), HasSubstr(refusal));
  EXPECT_THAT(message_of([&] { static_cast<void>(occluded(hull, walls)); }), HasSubstr(refusal));
  EXPECT_THAT(message_of([&] { static_cast<void>(list_occluders(hull, walls, listed)); }), HasSubstr(refusal));
  const ConvexHull between = between_polygons(Points{{0, 0, 0}}, Points{{9, 0, 0}});
  EXPECT_THAT(message_of([&] { static_cast<void>(occluded(casters(between, {0, 9, 0}), wall)); }), HasSubstr(refusal));
}

TEST(HullBlocking, EndsThatMakeNoHullAreRefused) {
  const Points one = {{0, 0, 0}};
  const auto refusal = [](const Points& p, const Points& q) {
    return message_of([&] { static_cast<void>(between_polygons(p, q)); });
  };
  EXPECT_THAT(refusal({}, one), HasSubstr("between_polygons: p has no corner"));
  EXPECT_THAT(refusal(one, {}), HasSubstr("between_polygons: q has no corner"));
  EXPECT_THAT(refusal(Points(30, Vec3{}), Points(3, Vec3{})),
              HasSubstr("between_polygons: p has 30 corners and q 3; together there can be 32"));
  EXPECT_THAT(refusal(one, {{0, nan, 0}}), HasSubstr("between_polygons: q: corner 0: y = nan is not finite"));
  EXPECT_THAT(message_of([&] { static_cast<void>(between_polygons(one, one, static_cast<HullTest>(9))); }),
              HasSubstr("test = 9"));
  EXPECT_EQ(between_polygons(one, one, HullTest::conservative).test(), HullTest::conservative);
}

TEST(HullBlocking, EndsOfAnyMagnitude) {
  Random random(4);
  std::size_t blocked = 0;
  for (std::uint64_t i = 0; i != random_cases(150); ++i) {
    const int high = static_cast<int>(random.integer(-140, 127));
    const int low = std::max(-149, high - 6);
    Ends ends;
    for (unsigned c = 0; c != 3; ++c) {
      ends.p.push_back({-std::abs(random.wild(low, high)), random.wild(low, high), random.wild(low, high)});
      ends.q.push_back({std::abs(random.wild(low, high)), random.wild(low, high), random.wild(low, high)});
    }
    const ConvexHull hull = between_polygons(ends.p, ends.q);
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 20; ++b) {
      Box box{{0, -3e38F, -3e38F}, {0, 3e38F, 3e38F}};
      if (random.one_in(2)) box.lo[1 + random.below(2)] = random.wild(low, high);
      if (random.one_in(2)) box.hi[0] = std::abs(random.wild(low, high));
      if (box.lo[1] <= box.hi[1] && box.lo[2] <= box.hi[2]) boxes.push_back(box);
    }
    std::vector<std::uint32_t> right;
    for (std::uint32_t b = 0; b != boxes.size(); ++b) {
      if (oracle::blocks(ends.p, ends.q, boxes[b])) right.push_back(b);
    }
    blocked += right.size();
    const BoxColumns memory(boxes);
    on_each_instruction_set([&] {
      std::vector<std::uint32_t> listed(boxes.size());
      listed.resize(list_occluders(hull, memory.view(), listed));
      EXPECT_EQ(listed, right);
    });
  }
  EXPECT_GT(blocked, random_cases(150));
}

}  // namespace
}  // namespace shaftcull
