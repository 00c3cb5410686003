// SPDX-License-Identifier: MIT
/// Triangles against convex hulls, exactly, with either contact: on every instruction set, in views, alone and in
/// trees.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "columns.hpp"
#include "hull/with_contact.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/hulls.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "oracle/triangle.hpp"
#include "result_words.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/triangles.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using Bits = std::vector<std::uint64_t>;

struct Right {
  bool is_outside;
  bool is_inside;
};

/// How many triangles were kept, and how many that are outside the box around them is not.
struct Found {
  std::size_t kept = 0;
  std::size_t only_exactly_outside = 0;
};

void expect_answers(const HullInput& input, HullTest test, Contact contact, const std::vector<Triangle>& triangles,
                    const std::vector<Right>& right) {
  const ConvexHull hull(input.points, input.directions, test);
  const CompiledShaft shaft = with_contact(hull, contact);
  const TriangleColumns memory(triangles);
  const TriangleTree tree{std::span<const Triangle>(triangles)};
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    Bits kept(bit_words(triangles.size()), 0x5555);
    Bits culled = kept;
    Bits inside = kept;
    Bits tree_kept = kept;
    Bits tree_inside = kept;
    cull(shaft, memory.view(), culled);
    classify(shaft, memory.view(), kept, inside);
    classify(shaft, tree, tree_kept, tree_inside);
    EXPECT_EQ(culled, kept);
    EXPECT_EQ(tree_kept, kept) << "in a tree";
    EXPECT_EQ(tree_inside, inside) << "in a tree";
    for (std::size_t i = 0; i != triangles.size(); ++i) {
      ASSERT_TRUE(bit(kept, i) == !right[i].is_outside && bit(inside, i) == right[i].is_inside)
          << "on " << name(isa) << (contact == Contact::open ? ", open" : ", closed") << "; triangle " << i << ":\n  "
          << source_text(input) << "\n  " << source_text(triangles[i]) << "\n  is "
          << (right[i].is_outside  ? "outside"
              : right[i].is_inside ? "inside"
                                   : "overlap")
          << ", answered otherwise";
      ASSERT_EQ(keeps(shaft, triangles[i]), bit(kept, i)) << "alone: " << source_text(triangles[i]);
    }
  }
}

Found expect_exact(const HullInput& input, const std::vector<Triangle>& triangles) {
  const oracle::ConvexHull closed(input);
  const oracle::OpenConvexHull open(input);
  Found found;
  for (const Contact contact : {Contact::closed, Contact::open}) {
    std::vector<Right> right;
    for (const Triangle& triangle : triangles) {
      const bool misses = closed.misses(triangle);
      const bool is_outside = contact == Contact::open ? open.misses(triangle) : misses;
      EXPECT_TRUE(is_outside || !misses);
      const bool is_inside = !is_outside && std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [&](auto& v) {
        return closed.answer(Box{v, v}) == Answer::inside;
      });
      right.push_back({is_outside, is_inside});
      found.kept += is_outside ? 0 : 1;
      found.only_exactly_outside +=
          is_outside && closed.answer(oracle::box_around(triangle)) != Answer::outside ? 1 : 0;
    }
    for (const HullTest test : {HullTest::exact, HullTest::conservative})
      expect_answers(input, test, contact, triangles, right);
  }
  return found;
}

Vec3 between(Random& random, const Vec3& p, const Vec3& q, float low, float high) {
  const float share = random.one_in(4) ? random.integer(0, 1) : random.uniform(low, high);
  Vec3 at{};
  for (std::size_t k = 0; k != 3; ++k) at[k] = random.nudge(p[k] + share * (q[k] - p[k]));
  return at;
}

/// A triangle with vertices on lines through points of the hull, but for an ulp or two: within it, at its surface or
/// outside.
Triangle near_triangle(Random& random, const HullInput& input) {
  const auto point = [&]() -> const Vec3& {
    return input.points[random.below(static_cast<unsigned>(input.points.size()))];
  };
  Triangle triangle{};
  for (Vec3& vertex : triangle.vertex) {
    vertex = between(random, between(random, point(), point(), 0, 1), point(), -1.5F, 2.5F);
    if (random.one_in(6)) vertex = random.vec3(-12, 12);
  }
  auto& [v0, v1, v2] = triangle.vertex;
  if (random.one_in(8)) v2 = v1;
  if (random.one_in(16)) v1 = v2 = v0;
  if (random.one_in(6)) {  // along an edge of the hull, perhaps
    const Vec3& p = point();
    const Vec3& q = point();
    for (std::size_t k = 0; k != 3; ++k) v1[k] = v0[k] + (q[k] - p[k]);
  }
  return triangle;
}

Triangle grid_triangle(Random& random, int side) {
  Triangle triangle{};
  for (Vec3& vertex : triangle.vertex) {
    vertex = {random.integer(-side, side), random.integer(-side, side), random.integer(-side, side)};
  }
  return triangle;
}

TEST(HullTriangles, RandomOnesAreAnsweredExactly) {
  Random random(1);
  Found found;
  for (std::uint64_t i = 0; i != random_cases(60); ++i) {
    const HullInput input = hull_of(random, 8, [&] { return random.uniform(-5, 5); });
    std::vector<Triangle> triangles;
    for (unsigned t = 0; t != 12; ++t) {
      const float size = random.one_in(3) ? 20.0F : 4.0F;
      const Vec3 centre = random.vec3(-7, 7);
      Triangle triangle{};
      for (Vec3& vertex : triangle.vertex) {
        for (std::size_t k = 0; k != 3; ++k) vertex[k] = centre[k] + random.uniform(-size, size);
      }
      triangles.push_back(triangle);
    }
    const Found here = expect_exact(input, triangles);
    found.kept += here.kept;
    found.only_exactly_outside += here.only_exactly_outside;
    if (HasFailure()) return;
  }
  EXPECT_GT(found.kept, random_cases(60) * 3);  // a quarter of the 12 of each; 0.4 are kept of many
  EXPECT_GT(found.only_exactly_outside, random_cases(60));
}

TEST(HullTriangles, ThoseNextToHullsOfEveryFamilyAreAnsweredExactly) {
  for (const HullFamily& family : hull_families) {
    SCOPED_TRACE(family.name);
    Random random(2);
    for (std::uint64_t i = 0; i != random_cases(30); ++i) {
      const HullInput input = family.input(random);
      std::vector<Triangle> triangles;
      while (triangles.size() != 10) {
        const Triangle triangle = near_triangle(random, input);
        const bool is_finite = std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [](const Vec3& v) {
          return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
        });
        if (is_finite) triangles.push_back(triangle);
      }
      expect_exact(input, triangles);
      if (HasFailure()) return;
    }
  }
}

TEST(HullTriangles, OnAGridWhereHullsAndTrianglesAreFlatAndStraight) {
  Random random(3);
  for (std::uint64_t i = 0; i != random_cases(250); ++i) {
    const int side = 1 + static_cast<int>(random.below(2));
    HullInput input = hull_of(random, random.one_in(2) ? 3 : 6, [&] { return random.integer(-side, side); });
    if (random.one_in(3)) {
      const std::size_t k = random.below(3);
      const std::size_t from = random.below(3);
      for (Vec3& p : input.points) p[k] = from == k ? 0 : p[from];
      std::erase_if(input.directions, [&](Vec3& d) {
        d[k] = from == k ? 0 : d[from];
        return d == Vec3{0, 0, 0};
      });
    }
    std::vector<Triangle> triangles;
    while (triangles.size() != 14) {
      Triangle triangle = grid_triangle(random, side + 1);
      if (random.one_in(4)) {  // in a plane across an axis, that of the hull perhaps
        const std::size_t k = random.below(3);
        for (Vec3& v : triangle.vertex) v[k] = 0;
      }
      if (random.one_in(6)) triangle.vertex[2] = triangle.vertex[1];
      triangles.push_back(triangle);
    }
    expect_exact(input, triangles);
    if (HasFailure()) return;
  }
}

TEST(HullTriangles, CastersOfALightInAViewAreAnsweredAsTheView) {
  Random random(8213);
  for (std::size_t n = 0; n != random_cases(40); ++n) {
    HullInput input;
    for (int i = 0; i != 8; ++i) input.points.push_back(random.vec3(-8, 8));
    const ConvexHull view(input.points);
    Vec3 middle{};
    for (const Vec3& point : input.points) {
      for (std::size_t k = 0; k != 3; ++k) middle[k] += point[k] / 8;
    }
    const ConvexHull with_light = casters(view, middle);
    for (const Contact contact : {Contact::closed, Contact::open}) {
      const CompiledShaft of_view = with_contact(view, contact);
      const CompiledShaft of_light = with_contact(with_light, contact);
      for (int i = 0; i != 64; ++i) {
        const Triangle triangle = near_triangle(random, input);
        ASSERT_EQ(keeps(of_light, triangle), keeps(of_view, triangle)) << source_text(triangle);
      }
    }
  }
}

TEST(HullTriangles, AHullOfTwoBoxesIsTheShaftBetweenThem) {
  Random random(4);
  for (std::uint64_t i = 0; i != random_cases(60); ++i) {
    const bool on_grid = random.one_in(2);
    const auto box = [&] { return on_grid ? random.grid_box(-3, 3) : random.box(-4, 4, 0, 2); };
    ShaftInput between{box(), box(), {}, Contact::closed};
    HullInput input;
    for (const Box* each : {&between.a, &between.b}) {
      for (unsigned c = 0; c != 8; ++c) {
        Vec3 corner{};
        for (std::size_t k = 0; k != 3; ++k) corner[k] = (c >> k & 1U) != 0 ? each->hi[k] : each->lo[k];
        input.points.push_back(corner);
      }
    }
    const ConvexHull hull(input.points);
    for (const Contact contact : {Contact::closed, Contact::open}) {
      const CompiledShaft of_hull = with_contact(hull, contact);
      const CompiledShaft shaft = compile(between.a, between.b, contact);
      between.contact = contact;
      for (const Isa isa : isas_under_test()) {
        const UseIsa use(isa);
        for (unsigned t = 0; t != 40; ++t) {
          const Triangle triangle = on_grid ? grid_triangle(random, 5) : near_triangle(random, input);
          ASSERT_EQ(keeps(of_hull, triangle), keeps(shaft, triangle))
              << source_text(between) << "\n  " << source_text(triangle);
          if (isa != isas_under_test().front() || t % 8 != 0) continue;
          ASSERT_EQ(keeps(of_hull, triangle), !oracle::is_outside(between, triangle, TriangleTest::exact))
              << source_text(between) << "\n  " << source_text(triangle);
        }
      }
    }
  }
}

TEST(HullTriangles, AsLargeAndAsSmallAsFloatsGo) {
  Random random(5);
  for (std::uint64_t i = 0; i != random_cases(60); ++i) {
    const int high = static_cast<int>(random.integer(-140, 127));
    const int low = std::max(-149, high - static_cast<int>(random.below(40)));
    const HullInput input = hull_of(random, 6, [&] { return random.wild(low, high); });
    std::vector<Triangle> triangles(8);
    for (Triangle& triangle : triangles) {
      for (Vec3& vertex : triangle.vertex) {
        vertex = {random.wild(low, high), random.wild(low, high), random.wild(low, high)};
        if (random.one_in(3)) vertex = input.points[random.below(static_cast<unsigned>(input.points.size()))];
      }
    }
    expect_exact(input, triangles);
    if (HasFailure()) return;
  }
}

TEST(HullTriangles, AWallThatHasNoVertexInTheShaftIsKeptWhereItCrossesIt) {
  // The shaft between a square and a leaning one; a wall in two triangles, one of which is wholly beside the shaft.
  const std::vector<Vec3> corners = {{0, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, 4, 4},
                                     {8, 0, 0}, {8, 4, 0}, {9, 0, 4}, {9, 4, 4}};
  const ConvexHull hull(corners);
  const Triangle across{{{{4, -30, -9}, {4, 30, -9}, {4, 0, 60}}}};
  const Triangle beside{{{{4, 9, -9}, {4, -9, 9}, {4, 9, 9}}}};  // its box is not beside
  const Triangle past{{{{4, 9, -0.5F}, {4, 9, 9}, {4, 4.5F, 9}}}};
  const Triangle floor{{{{0, 0, 0}, {9, 0, 0}, {0, 4, 0}}}};
  on_each_instruction_set([&] {
    EXPECT_TRUE(keeps(hull, across));
    EXPECT_TRUE(keeps(hull, beside));
    EXPECT_FALSE(keeps(hull, past));
    EXPECT_TRUE(keeps(hull, floor));
    const CompiledShaft open = with_contact(hull, Contact::open);
    EXPECT_TRUE(keeps(open, across));
    EXPECT_FALSE(keeps(open, floor));
  });
}

TEST(HullTriangles, WithoutFiniteVerticesAreAnsweredByVertices) {
  const ConvexHull hull(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}});
  const std::vector<Triangle> triangles = {{{{{1, 1, 1}, {9, 9, nan}, {9, 9, 9}}}},
                                           {{{{9, 9, 9}, {9, 9, infinity}, {-9, 9, 9}}}},
                                           {{{{nan, nan, nan}, {nan, 1, 1}, {nan, 1, 1}}}},
                                           {{{{-infinity, 1, 1}, {infinity, 1, 1}, {0, 9, 9}}}}};
  const TriangleColumns memory(triangles);
  on_each_instruction_set([&] {
    for (const Contact contact : {Contact::closed, Contact::open}) {
      Bits exactly(1);
      Bits by_vertices(1);
      const CompiledShaft shaft = with_contact(hull, contact);
      cull(shaft, memory.view(), exactly);
      cull(shaft, memory.view(), by_vertices, {.triangle_test = TriangleTest::vertices});
      EXPECT_EQ(exactly, by_vertices);
    }
  });
}

}  // namespace
}  // namespace shaftcull
