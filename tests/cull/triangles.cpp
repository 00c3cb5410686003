// SPDX-License-Identifier: MIT
/// Triangles against shafts: every answer of both tests equals the one of exact arithmetic.
#include "shaftcull/triangles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "columns.hpp"
#include "cull/agreement.hpp"
#include "guarded_floats.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/cases/triangles.hpp"
#include "oracle/hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/triangle.hpp"
#include "result_words.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/volumes.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

constexpr TriangleTest tests[] = {TriangleTest::vertices, TriangleTest::exact};

using Bits = std::vector<std::uint64_t>;

const char* name(TriangleTest test) { return test == TriangleTest::exact ? "triangles" : "vertices"; }

Bits kept_of(const CompiledShaft& shaft, const TriangleView& triangles, TriangleTest test) {
  Bits kept(bit_words(triangles.count), 0x5555);
  cull(shaft, triangles, kept, {.triangle_test = test});
  return kept;
}

/// The shaft with closed contact.
oracle::Hull closed_hull(const ShaftInput& input) { return {input.a, input.b, input.added}; }
oracle::MovingHull closed_hull(const MovingInput& input) { return oracle::MovingHull(input); }

/// Whether all vertices are inside, as points.
template <class Hull>
bool has_vertices_inside(const Hull& hull, const Triangle& triangle) {
  return std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [&](const Vec3& vertex) {
    return hull.answer(Box{vertex, vertex}) == Answer::inside;
  });
}

template <class Input>
Input opened(Input input) {
  input.contact = Contact::open;
  return input;
}

/// How many triangles some tests said something of.
struct Found {
  std::size_t kept = 0;
  std::size_t only_exactly_outside = 0;  ///< which the test by vertices keeps
};

/// Fails, with a reproducer for the first wrong one, unless both tests answer as the oracle does.
template <class Input>
Found expect_exact_triangles(const Input& input, const std::vector<Triangle>& triangles) {
  const TriangleColumns memory(triangles);
  const CompiledShaft shaft = shaft_of(input);
  const auto hull = closed_hull(input);
  Found found;
  std::vector<bool> outside;
  std::vector<bool> outside_by_vertices;
  for (const TriangleTest test : tests) {
    std::vector<bool>& right = test == TriangleTest::exact ? outside : outside_by_vertices;
    std::vector<bool> inside;
    for (const Triangle& triangle : triangles) {
      right.push_back(oracle::is_outside(input, triangle, test));
      inside.push_back(!right.back() && has_vertices_inside(hull, triangle));
    }
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      const Bits kept = kept_of(shaft, memory.view(), test);
      Bits kept_too(kept.size(), 0x5555);
      Bits inside_bits(kept.size(), 0x5555);
      classify(shaft, memory.view(), kept_too, inside_bits, {.triangle_test = test});
      EXPECT_EQ(kept_too, kept) << "cull() and classify() keep different triangles of " << source_text(input);
      std::size_t wrong = 0;
      std::size_t first = 0;
      for (std::size_t i = triangles.size(); i-- != 0;) {
        if (bit(kept, i) == !right[i] && bit(inside_bits, i) == inside[i]) continue;
        ++wrong;
        first = i;
      }
      EXPECT_EQ(wrong, 0U) << "of " << triangles.size() << " on " << shaftcull::name(isa) << ", form " << name(test)
                           << "; the first is bound " << first << ":\n  " << source_text(input) << "\n  "
                           << source_text(triangles[first]) << "\n  is "
                           << (right[first]    ? "outside"
                               : inside[first] ? "inside"
                                               : "overlap")
                           << ", answered otherwise";
    }
  }
  for (std::size_t i = 0; i != triangles.size(); ++i) {
    found.kept += outside[i] ? 0U : 1U;
    found.only_exactly_outside += outside[i] && !outside_by_vertices[i] ? 1U : 0U;
    EXPECT_FALSE(outside_by_vertices[i] && !outside[i]) << "what is outside by vertices is outside";
  }
  return found;
}

/// Checks `shafts` random inputs, each with 70 triangles that `triangle_of` makes for it. One triangle in `kept_in` is
/// kept, and one in `missed_in` outside for none but the exact test, or more; 0 asks for neither.
template <class MakeShaft, class MakeTriangle>
void check(std::uint64_t seed, std::size_t shafts, std::size_t kept_in, std::size_t missed_in,
           const MakeShaft& shaft_of, const MakeTriangle& triangle_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t all = 0;
  Found sum;
  for (std::size_t i = 0; i != random_cases(shafts) && !testing::Test::HasFailure(); ++i) {
    const auto input = shaft_of(random);
    std::vector<Triangle> some;
    for (int n = 0; n != 70; ++n) some.push_back(triangle_of(random, input));
    const Found found = expect_exact_triangles(input, some);
    all += some.size();
    sum.kept += found.kept;
    sum.only_exactly_outside += found.only_exactly_outside;
  }
  if (kept_in == 0) return;
  EXPECT_GE(sum.kept * kept_in, all) << "too few triangles are kept";
  EXPECT_GE(sum.only_exactly_outside * missed_in, all) << "too few triangles are for the exact test alone";
}

TEST(Triangles, RandomOnesAreAnsweredExactly) { check(801, 20, 10, 30, random_shaft, nearby_triangle); }

TEST(Triangles, ThoseThatJustTouchOrJustDoNotAreAnsweredExactly) {
  check(802, 30, 8, 40, random_shaft, touching_triangle);
  check(
      803, 20, 8, 100, [](Random& random) { return long_shaft(random, random.one_in(2)); }, touching_triangle);
}

TEST(Triangles, ThoseOnAGridAreAnsweredExactly) {
  check(
      804, 40, 10, 60, [](Random& random) { return grid_shaft(random, 4); },
      [](Random& random, const ShaftInput&) { return grid_triangle(random, -1, 5); });
  check(
      805, 20, 10, 60, [](Random& random) { return grid_shaft(random, 4); },
      [](Random& random, const ShaftInput&) { return grid_triangle(random, -9, 13); });
}

TEST(Triangles, ThoseThatShareVerticesWithTheEndsAreAnsweredExactly) {
  check(806, 20, 2, 500, random_shaft, [](Random& random, const ShaftInput& input) {
    Triangle triangle = nearby_triangle(random, input);
    const auto corner = [&] {
      const Box& box = random.one_in(2) ? input.a : input.b;
      Vec3 point{};
      for (std::size_t k = 0; k != 3; ++k) point[k] = random.one_in(2) ? box.lo[k] : box.hi[k];
      return point;
    };
    for (Vec3& vertex : triangle.vertex) {
      if (random.one_in(2)) vertex = corner();
    }
    return triangle;
  });
}

TEST(Triangles, FlatAndStraightShaftsAreAnsweredExactly) {
  check(807, 30, 20, 200, degenerate_shaft, touching_triangle);
  check(
      808, 30, 20, 200,
      [](Random& random) {
        ShaftInput input = grid_shaft(random, 4);
        for (std::size_t k = 0; k != 3; ++k) {
          if (random.one_in(2)) input.a.hi[k] = input.a.lo[k] = input.b.hi[k] = input.b.lo[k];
        }
        return input;
      },
      [](Random& random, const ShaftInput&) { return grid_triangle(random, -1, 5); });
}

TEST(Triangles, ShaftsOfEveryFamilyAreAnsweredExactly) {
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    unsigned index = 0;
    check(
        809, 2, 0, 0, [&](Random& random) { return family.shaft(random, index++ * 61); },
        [&](Random& random, const ShaftInput& input) {
          return random.one_in(3) ? nearby_triangle(random, input) : touching_triangle(random, input);
        });
  }
}

TEST(Triangles, EveryMagnitudeIsAnsweredExactly) {
  for (const int exponent : {-149, -140, -126, -100, -40, 30, 60, 100, 121}) {
    check(
        810, 3, 40, 300, [=](Random& random) { return wild_shaft(random, exponent, exponent + 6); },
        [=](Random& random, const ShaftInput& input) {
          return random.one_in(2) ? wild_triangle(random, exponent, exponent + 6) : touching_triangle(random, input);
        });
  }
  check(
      811, 10, 200, 500, [](Random& random) { return wild_shaft(random); },
      [](Random& random, const ShaftInput& input) {
        return random.one_in(2) ? wild_triangle(random) : touching_triangle(random, input);
      });
}

/// A triangle that turns so little in a projection that rounding may take it for one that turns the other way: its
/// third vertex is on the line of the others there, but for an ulp or two, and sometimes very near one of them.
Triangle needle(Random& random, const ShaftInput& input) {
  Triangle triangle = nearby_triangle(random, input);
  auto& [v0, v1, v2] = triangle.vertex;
  const std::size_t upright = random.below(3);
  const double t = random.one_in(2) ? static_cast<double>(random.uniform(-1, 2))
                                    : 1 + static_cast<double>(std::exp2(random.uniform(-30, -5)));
  for (std::size_t k = 0; k != 3; ++k) {
    if (k == upright) continue;
    const auto from = static_cast<double>(v0[k]);
    v2[k] = random.nudge(static_cast<float>(from + t * (static_cast<double>(v1[k]) - from)));
  }
  std::rotate(triangle.vertex.begin(), triangle.vertex.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
              triangle.vertex.end());
  if (random.one_in(2)) std::swap(v0, v1);
  return triangle;
}

TEST(Triangles, NeedlesAndNearlyUprightWallsAreAnsweredExactly) { check(812, 30, 20, 60, random_shaft, needle); }

TEST(Triangles, AddedPlanesAreAskedAtVertices) {
  const auto at_plane = [](Random& random, const ShaftInput& input) {
    Triangle triangle = nearby_triangle(random, input);
    if (random.one_in(3)) return triangle;
    const Plane& plane = input.added[random.below(static_cast<unsigned>(input.added.size()))];
    for (Vec3& vertex : triangle.vertex) {  // onto the plane, or beyond, as nearly as floats are
      const std::size_t k = random.below(3);
      if (plane.normal[k] == 0 || random.one_in(3)) continue;
      double rest = static_cast<double>(plane.offset);
      for (std::size_t i = 0; i != 3; ++i) {
        if (i != k) rest -= static_cast<double>(plane.normal[i]) * static_cast<double>(vertex[i]);
      }
      vertex[k] =
          random.nudge(static_cast<float>(std::clamp(rest / static_cast<double>(plane.normal[k]), -3e38, 3e38)));
    }
    return triangle;
  };
  check(
      813, 20, 40, 1000, [](Random& random) { return with_planes(random, random_shaft(random), false); }, at_plane);
  check(
      814, 20, 40, 1000, [](Random& random) { return with_planes(random, grid_shaft(random, 4), true); },
      [](Random& random, const ShaftInput&) { return grid_triangle(random, -1, 5); });
  check(
      815, 15, 40, 1000, [](Random& random) { return with_wild_planes(random, random_shaft(random)); }, at_plane);
}

TEST(Triangles, AVertexFarAwayThatAlmostTouchesAnAddedPlaneIsAnsweredExactly) {
  const auto halved = [](Random& random) {
    ShaftInput input{{{-3000, -3000, -3000}, {3000, 3000, 3000}}, {{-2999, -2999, -2999}, {2999, 2999, 2999}}};
    input.added.push_back({random.vec3(-1, 1), random.uniform(-0.01F, 0.01F)});
    return input;
  };
  // The other two vertices are near the origin: of all coordinates, which the margin grows with, those of one count.
  const auto spike = [](Random& random, const ShaftInput& input) {
    const Plane& plane = input.added.front();
    const float side = random.one_in(2) ? 1.0F : -1.0F;
    Triangle triangle;
    for (Vec3& vertex : triangle.vertex) {
      for (std::size_t k = 0; k != 3; ++k) vertex[k] = side * plane.normal[k] + random.uniform(-0.1F, 0.1F);
    }
    Vec3& far = triangle.vertex[random.below(3)];
    far = random.vec3(-1000, 1000);
    const std::size_t k = random.below(3);
    double rest = static_cast<double>(plane.offset);
    for (std::size_t i = 0; i != 3; ++i) {
      if (i != k) rest -= static_cast<double>(plane.normal[i]) * static_cast<double>(far[i]);
    }
    far[k] = static_cast<float>(std::clamp(rest / static_cast<double>(plane.normal[k]), -2900.0, 2900.0));
    return triangle;
  };
  check(820, 60, 0, 0, halved, spike);
}

/// A moving box's shaft, of boxes on a grid or not.
MovingInput moving_input(Random& random, MovingInput::Kind kind, bool on_grid) {
  const auto box = [&] { return on_grid ? random.grid_box(0, 4) : random.box(-3, 3, 0.05F, 1.0F); };
  MovingInput input{kind, box()};
  do {
    input.displacement =
        on_grid ? Vec3{random.integer(-3, 3), random.integer(-3, 3), random.integer(-3, 3)} : random.vec3(-3, 3);
    if (random.one_in(3)) input.displacement[random.below(3)] = 0;
  } while (input.displacement == Vec3{0, 0, 0});
  input.light = box();
  const std::size_t axis = random.below(3);
  const float away = input.box.hi[axis] - input.light.lo[axis] + (on_grid ? 1.0F : random.uniform(0.01F, 3.0F));
  input.light.lo[axis] += away;
  input.light.hi[axis] += away;
  input.reach = on_grid ? random.integer(1, 3) : 1 + std::exp2(random.uniform(-6, 5));
  return input;
}

TEST(Triangles, ShaftsOfMovingBoxesAreAnsweredExactly) {
  using Kind = MovingInput::Kind;
  for (const Kind kind : {Kind::swept, Kind::swept_infinite, Kind::shadow, Kind::shadow_without_end}) {
    for (const bool on_grid : {false, true}) {
      check(
          816, 3, 30, 300, [&](Random& random) { return moving_input(random, kind, on_grid); },
          [&](Random& random, const MovingInput& input) {
            if (on_grid) return random.one_in(2) ? grid_triangle(random, -1, 5) : grid_triangle(random, -12, 12);
            // Near where a corner passes, somewhere on its way.
            const float t = random.one_in(2) ? random.uniform(0, 1) : std::exp2(random.uniform(-2, 8));
            ShaftInput near{input.box, input.box};
            for (std::size_t k = 0; k != 3; ++k) {
              const Box& light = input.light;
              near.b.lo[k] += t * (input.is_shadow() ? input.box.lo[k] - light.hi[k] : input.displacement[k]);
              near.b.hi[k] += t * (input.is_shadow() ? input.box.hi[k] - light.lo[k] : input.displacement[k]);
            }
            return random.one_in(2) ? nearby_triangle(random, near) : touching_triangle(random, near);
          });
    }
  }
}

TEST(Triangles, WhatOnlyTouchesOpenShaftsIsAnsweredExactly) {
  const auto on_lattice = [](Random& random, const ShaftInput&) { return grid_triangle(random, -1, 5); };
  check(
      830, 20, 50, 1000, [](Random& random) { return opened(lattice_shaft(random)); }, on_lattice);
  check(
      831, 10, 50, 1000, [](Random& random) { return opened(with_planes(random, lattice_shaft(random), true)); },
      on_lattice);
  check(
      832, 10, 50, 1000, [](Random& random) { return opened(random_shaft(random)); }, touching_triangle);
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    unsigned index = 0;
    check(
        833, 1, 0, 0, [&](Random& random) { return opened(family.shaft(random, index++ * 61)); }, touching_triangle);
  }
}

TEST(Triangles, WhatOnlyTouchesOpenShaftsOfMovingBoxesIsAnsweredExactly) {
  using Kind = MovingInput::Kind;
  for (const Kind kind : {Kind::swept, Kind::swept_infinite, Kind::shadow, Kind::shadow_without_end}) {
    check(
        834, 3, 50, 1000,
        [&](Random& random) {
          MovingInput input = opened(moving_input(random, kind, true));
          for (std::size_t k = 0; k != 3; ++k) {
            if (random.one_in(3)) input.box.hi[k] = input.box.lo[k];
          }
          return input;
        },
        [](Random& random, const MovingInput&) { return grid_triangle(random, -2, 6); });
  }
}

TEST(Triangles, ThoseOfAPatchesOwnWallAreOutsideOfAnOpenShaft) {
  // From a patch of the floor z = 0 to one of the wall x = 4.
  CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 0}}, Box{{4, 0, 1}, {4, 1, 2}});
  const Triangle floor{{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}}};
  const Triangle wall{{{{4, -9, -9}, {4, 9, -9}, {4, 0, 9}}}};
  const Triangle across{{{{2, -9, -9}, {2, 9, -9}, {2, 0, 9}}}};
  for (const TriangleTest test : tests) {
    set_contact(shaft, Contact::closed);
    for (const Triangle& triangle : {floor, wall, across}) EXPECT_TRUE(keeps(shaft, triangle, test));
    set_contact(shaft, Contact::open);
    EXPECT_FALSE(keeps(shaft, floor, test));
    EXPECT_FALSE(keeps(shaft, wall, test));
    EXPECT_TRUE(keeps(shaft, across, test));
  }
  // A shaft in the plane of the floor is kept apart from what is beside it in that plane, not from what it crosses.
  CompiledShaft flat = compile(Box{{0, 0, 0}, {1, 1, 0}}, Box{{4, 0, 0}, {5, 1, 0}}, Contact::open);
  EXPECT_TRUE(keeps(flat, floor));
  EXPECT_FALSE(keeps(flat, Triangle{{{{0, 1, 0}, {5, 1, 0}, {2, 3, 0}}}}));
  EXPECT_FALSE(keeps(flat, Triangle{{{{0, 0, 0}, {5, 0, 0}, {2, 1, 1}}}})) << "only an edge of it is in the plane";
}

TEST(Triangles, ASlantedTriangleThatItsBoxHidesIsOutsideForTheExactTestAlone) {
  // It faces a corner of the shaft, which is within its box.
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{0, 0, 4}, {1, 1, 5}});
  const Triangle triangle{{{{2, 0.9F, 2}, {0.9F, 2, 2}, {2, 2, 3}}}};
  EXPECT_TRUE(keeps(shaft, triangle, TriangleTest::vertices));
  EXPECT_FALSE(keeps(shaft, triangle, TriangleTest::exact));
  EXPECT_FALSE(keeps(shaft, triangle)) << "which is what is asked for if nothing is said";
}

TEST(Triangles, AVertexThatTouchesACornerIsKept) {
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{0, 0, 4}, {1, 1, 5}});
  for (const TriangleTest test : tests) {
    EXPECT_TRUE(keeps(shaft, Triangle{{{{1, 1, 3}, {2, 1, 3}, {1, 2, 3}}}}, test));
    EXPECT_FALSE(keeps(shaft, Triangle{{{{std::nextafter(1.0F, 2.0F), 1, 3}, {2, 1, 3}, {1.5F, 2, 3}}}}, test));
  }
}

TEST(Triangles, APlaneAddedToAShaftCullsWhatItsBoxWouldKeep) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const Plane plane{{1, 1, 0}, 2.9F};
  const Triangle triangle{{{{2, 0.95F, 0}, {2.9F, 0.05F, 0}, {2.5F, 0.5F, 1}}}};
  const CompiledShaft shaft = compile(box, {{4, 0, 0}, {5, 1, 1}}, std::span(&plane, 1));
  EXPECT_TRUE(keeps(shaft, oracle::box_around(triangle)));
  for (const TriangleTest test : tests) EXPECT_FALSE(keeps(shaft, triangle, test));
}

TEST(Triangles, AHullIsAskedByVerticesAndExactly) {
  const ConvexHull hull(std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}});
  const std::vector<Triangle> triangles = {{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}},
                                           {{{{2, 2, 2}, {3, 2, 2}, {2, 3, 2}}}},
                                           {{{{1, 1, 1}, {5, 1, 1}, {1, 5, 1}}}}};
  const TriangleColumns memory(triangles);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const TriangleTest test : tests) {
      EXPECT_EQ(kept_of(hull, memory.view(), test), Bits{0b101}) << shaftcull::name(isa);
    }
  }
  const CompiledShaft shafts[] = {compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{0, 0, 4}, {1, 1, 5}}), hull};
  std::vector<std::uint64_t> counts{7, 7};
  count_many(shafts, memory.view(), counts);
  EXPECT_EQ(counts[1], 2U);
}

TEST(Triangles, CoordinatesThatAreNotFiniteAreAnsweredAsPromised) {
  const Box a{{0, 0, 0}, {1, 1, 1}};
  const Box b{{0, 0, 4}, {1, 1, 5}};
  const Plane plane{{0, 0, 1}, 3};
  const CompiledShaft with_plane = compile(a, b, std::span(&plane, 1));
  const CompiledShaft plain = compile(a, b);
  const Triangle inside{{{{0.2F, 0.2F, 2}, {0.8F, 0.2F, 2}, {0.2F, 0.8F, 2}}}};
  const Triangle beyond{{{{0.2F, 0.2F, 4}, {0.8F, 0.2F, 4}, {0.2F, 0.8F, 4}}}};
  const Triangle apart{{{{2, 0.2F, 2}, {3, 0.2F, 2}, {2, 0.8F, 2}}}};
  std::vector<Triangle> triangles;
  std::vector<bool> kept;
  std::vector<bool> kept_with_plane;
  const auto expect = [&](const Triangle& triangle, bool plainly, bool by_plane) {
    triangles.push_back(triangle);
    kept.push_back(plainly);
    kept_with_plane.push_back(by_plane);
  };
  const auto with = [](Triangle triangle, std::size_t v, std::size_t k, float x) {
    triangle.vertex[v][k] = x;
    return triangle;
  };
  for (std::size_t v = 0; v != 3; ++v) {
    for (std::size_t k = 0; k != 3; ++k) {
      for (const float x : {nan, infinity, -infinity}) {
        expect(with(inside, v, k, x), true, true);
        // The plane reads z alone: a vertex is not beyond it if that is not finite.
        expect(with(beyond, v, k, x), true, k == 2);
        expect(with(apart, v, k, x), k == 0 && x == -infinity, k == 0 && x == -infinity);
      }
    }
  }
  for (std::size_t k = 0; k != 3; ++k) {
    Triangle empty = inside;
    for (Vec3& vertex : empty.vertex) vertex[k] = nan;
    expect(empty, false, false);
    Triangle far = inside;
    for (Vec3& vertex : far.vertex) vertex[k] = k == 1 ? -infinity : infinity;
    expect(far, false, false);
    Triangle wide = apart;  // from one end of the axis to the other
    wide.vertex[0][k] = -infinity;
    wide.vertex[1][k] = infinity;
    expect(wide, k == 0, k == 0);
  }
  const TriangleColumns memory(triangles);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const TriangleTest test : tests) {
      const Bits plain_bits = kept_of(plain, memory.view(), test);
      const Bits plane_bits = kept_of(with_plane, memory.view(), test);
      for (const CompiledShaft& asked : {plain, with_plane}) {
        Bits inside_bits(plain_bits.size(), 0x5555);
        classify(asked, memory.view(), {}, inside_bits, {.triangle_test = test});
        EXPECT_EQ(inside_bits, Bits(plain_bits.size())) << shaftcull::name(isa) << ", " << name(test);
      }
      for (std::size_t i = 0; i != triangles.size(); ++i) {
        EXPECT_EQ(bit(plain_bits, i), kept[i]) << shaftcull::name(isa) << ", " << name(test) << ", " << i;
        EXPECT_EQ(bit(plane_bits, i), kept_with_plane[i]) << shaftcull::name(isa) << ", " << name(test) << ", " << i;
      }
    }
  }
}

TEST(Triangles, EveryCountIsAnsweredAndNothingBehindItIsRead) {
  // What a vector finds behind the last triangle may be zeros, and a triangle at the origin touches these shafts: it is
  // one that floats leave undecided.
  const ShaftInput shafts[] = {{{{-1, -1, 0}, {1, 1, 1}}, {{-1, -1, 4}, {1, 1, 5}}},
                               {{{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {4, 1, 1}}},
                               {{{0, 0, 0}, {0, 0, 0}}, {{3, 2, 1}, {3, 2, 1}}, {{{1, 1, 1}, 0}}}};
  const Triangle touching{{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}};
  const Triangle outside{{{{9, 9, 9}, {10, 9, 9}, {9, 10, 9}}}};
  for (const ShaftInput& input : shafts) {
    const CompiledShaft shaft = shaft_of(input);
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      for (const TriangleTest test : tests) {
        for (std::size_t count = 0; count <= 130; ++count) {
          std::vector<Triangle> triangles(count, touching);
          Bits expected(bit_words(count));
          for (std::size_t i = 0; i != count; ++i) {
            if (i % 3 == 1) {
              triangles[i] = outside;
            } else {
              expected[i / 64] |= std::uint64_t{1} << i % 64;
            }
          }
          const TriangleColumns memory(triangles);
          const GuardedView guarded(memory.view());
          EXPECT_EQ(kept_of(shaft, guarded.view(), test), expected) << shaftcull::name(isa) << ", " << count;
          const std::size_t words = bit_words(count);
          Bits kept(words + 1, 0x5555);
          Bits inside(kept);
          classify(shaft, guarded.view(), std::span(kept).first(words), std::span(inside).first(words),
                   {.triangle_test = test});
          expected.push_back(0x5555);
          EXPECT_EQ(kept, expected) << shaftcull::name(isa) << ", " << count;
          EXPECT_EQ(inside, expected) << "a point of the shaft is inside, " << shaftcull::name(isa) << ", " << count;
        }
      }
    }
  }
}

TEST(Triangles, CountsListsAndManyShaftsSayWhatBitsSay) {
  Random random(821);
  const ShaftInput around = random_shaft(random);
  std::vector<Triangle> triangles;
  for (int i = 0; i != 5000; ++i) triangles.push_back(nearby_triangle(random, around));
  std::vector<CompiledShaft> shafts;
  for (int s = 0; s != 67; ++s) shafts.push_back(compile(random.box(-4, 4, 0, 0.5F), random.box(-4, 4, 0, 0.5F)));
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{255}, std::size_t{257}, triangles.size()}) {
    const TriangleColumns memory(std::vector<Triangle>(triangles.begin(), triangles.begin() + static_cast<int>(size)));
    const TriangleView view = memory.view();
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      for (const TriangleTest test : tests) {
        const Query query{.triangle_test = test};
        Bits rows(shafts.size() * bit_words(size), 0x5555);
        cull_many(shafts, view, rows, query);
        std::vector<std::uint64_t> counts(shafts.size(), 5);
        count_many(shafts, view, counts, query);
        Bits any_bits(2, 0x5555);
        any_many(shafts, view, any_bits, query);
        IndexLists lists;
        list_many(shafts, view, lists, query);
        ASSERT_EQ(lists.size(), shafts.size());
        for (std::size_t s = 0; s != shafts.size(); ++s) {
          const Bits kept = kept_of(shafts[s], view, test);
          EXPECT_TRUE(std::equal(kept.begin(), kept.end(), rows.begin() + static_cast<int>(s * bit_words(size))));
          std::vector<std::uint32_t> expected;
          for (std::uint32_t i = 0; i != size; ++i) {
            if (bit(kept, i)) expected.push_back(i);
          }
          EXPECT_EQ(count(shafts[s], view, query), expected.size());
          EXPECT_EQ(counts[s], expected.size());
          EXPECT_EQ(any(shafts[s], view, query), !expected.empty());
          EXPECT_EQ(bit(any_bits, s), !expected.empty());
          std::vector<std::uint32_t> listed(size);
          EXPECT_EQ(list(shafts[s], view, std::span(listed), query), expected.size());
          listed.resize(expected.size());
          EXPECT_EQ(listed, expected);
          EXPECT_TRUE(std::equal(expected.begin(), expected.end(), lists[s].begin(), lists[s].end()));
        }
      }
    }
  }
}

TEST(Triangles, WhatDoesNotFitIsCountedAndNotWritten) {
  const TriangleColumns memory(std::vector<Triangle>(20000, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}));
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}});
  std::vector<std::uint32_t> listed(4, 7);
  EXPECT_EQ(list(shaft, memory.view(), std::span(listed).first(3)), 20000U);
  EXPECT_EQ(listed, (std::vector<std::uint32_t>{0, 1, 2, 7}));
}

TEST(Triangles, BadArgumentsAreRefusedBeforeAnythingIsWritten) {
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}});
  const TriangleColumns memory(std::vector<Triangle>(65));
  const TriangleView view = memory.view();
  Bits kept(2, 7);
  EXPECT_THAT(message_of([&] { cull(shaft, view, std::span(kept).first(1)); }), testing::HasSubstr("kept has 1 word;"));
  EXPECT_THAT(message_of([&] { cull(shaft, view, kept, {.triangle_test = static_cast<TriangleTest>(9)}); }),
              testing::HasSubstr("test = 9 is neither"));
  EXPECT_THAT(message_of([&] { cull(CompiledShaft(), view, kept); }), testing::HasSubstr("shaft 0 was never formed"));
  TriangleView null = view;
  null.stream[7] = nullptr;
  EXPECT_THAT(message_of([&] { cull(shaft, null, kept); }), testing::HasSubstr("triangles.stream[7] is null"));
  EXPECT_EQ(kept, Bits(2, 7));
}

/// Its corner is on an edge of the shaft between two faces that do not move, and it leaves both.
TEST(TrianglesOfOpenShafts, ThatTouchAnEdgeWithACornerAreOutside) {
  const CompiledShaft closed = compile({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 9}, {1, 1, 10}});
  const CompiledShaft open = compile({{0, 0, 0}, {1, 1, 1}}, {{0, 0, 9}, {1, 1, 10}}, Contact::open);
  const std::vector<Triangle> triangles(70, Triangle{{{{1, 1, 5}, {0.5F, 2, 5}, {2, 0.5F, 5}}}});
  on_each_instruction_set([&] {
    EXPECT_EQ(count(closed, TriangleColumns(triangles).view()), 70U);
    EXPECT_EQ(count(open, TriangleColumns(triangles).view()), 0U);
  });
}

}  // namespace
}  // namespace shaftcull
