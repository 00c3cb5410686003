// SPDX-License-Identifier: MIT
/// Visible fractions: scenes in which they are known, and pairs of which shafts have the answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/random.hpp"
#include "shaftcull/shaftcull.hpp"
#include "visibility/fractions.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

/// A pair of rectangles that face each other, at z = 0 and z = 2, a unit square each.
PatchSet opposite(PatchSides sides = PatchSides::front) {
  return PatchSet(
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}},
      std::vector<std::size_t>{0, 4, 8}, sides);
}

float fraction_between_opposite(const Occluders& occluders, std::uint32_t rays = 4096) {
  const PatchSet patches = opposite();
  return fractions_of(patches, patches, occluders, {{0, 1}}, {.rays = rays})[0];
}

/// A rectangle at z = 1 from x = 0 to 0.5: half of the segments pass through it, as their middles are spread
/// symmetrically.
const std::vector<Vec3> half{{-1, -1, 1}, {0.5F, -1, 1}, {0.5F, 2, 1}, {-1, 2, 1}};
const std::vector<std::size_t> one_of_four{0, 4};

TEST(VisibleFraction, OfNothingBetweenIsAll) { EXPECT_EQ(fraction_between_opposite({}), 1); }

TEST(VisibleFraction, IsHalfBehindHalfAWallOfAnyKind) {
  constexpr double error = 0.01;
  Occluders polygon;
  polygon.add_polygons(half, one_of_four);
  EXPECT_NEAR(fraction_between_opposite(polygon), 0.5, error);
  Occluders flat_box;
  flat_box.add_solids(std::vector<Box>{{{-1, -1, 1}, {0.5F, 2, 1}}});
  EXPECT_NEAR(fraction_between_opposite(flat_box), 0.5, error);
  const Box thin{{-1, -1, 0.999F}, {0.5F, 2, 1.001F}};
  Occluders box;
  box.add_solids(std::vector<Box>{thin});
  EXPECT_NEAR(fraction_between_opposite(box), 0.5, error);
  Occluders bound;
  bound.add_boxes(std::vector<Box>{thin});
  EXPECT_EQ(fraction_between_opposite(bound), fraction_between_opposite(box));
  std::vector<Vec3> prism;
  for (const Vec3& corner : half) {
    for (const float z : {0.999F, 1.001F}) prism.push_back({corner[0], corner[1] + (corner[1] > 0 ? 0.01F : 0), z});
  }
  Occluders hull;
  hull.add_solid_hulls(prism, std::vector<std::size_t>{0, prism.size()});
  EXPECT_NEAR(fraction_between_opposite(hull), 0.5, error);
  // Triangles, in few and in many, from either side.
  for (const std::size_t n : {1U, 4U, 12U, 60U}) {
    for (const bool is_turned : {false, true}) {
      std::vector<Triangle> triangles;
      for (std::size_t i = 0; i != n; ++i) {
        const float from = -1 + 3 * static_cast<float>(i) / static_cast<float>(n);
        const float to = -1 + 3 * static_cast<float>(i + 1) / static_cast<float>(n);
        triangles.push_back({{Vec3{-1, from, 1}, Vec3{0.5F, from, 1}, Vec3{0.5F, to, 1}}});
        triangles.push_back({{Vec3{-1, from, 1}, Vec3{0.5F, to, 1}, Vec3{-1, to, 1}}});
      }
      for (Triangle& triangle : triangles) {
        if (is_turned) std::swap(triangle.vertex[0], triangle.vertex[1]);
      }
      const TriangleStream stream(triangles);
      Occluders group;
      group.add_triangles(stream.view(), std::vector<std::size_t>{0, triangles.size()});
      EXPECT_NEAR(fraction_between_opposite(group), 0.5, error) << n;
      Occluders groups;
      groups.add_triangles(stream.view());
      EXPECT_EQ(fraction_between_opposite(groups), fraction_between_opposite(group)) << n;
    }
  }
}

TEST(VisibleFraction, IsNoneBehindAWholeWallAndOfSeveralTogether) {
  Occluders both;
  both.add_polygons(half, one_of_four);
  EXPECT_GT(fraction_between_opposite(both), 0);
  both.add_solids(std::vector<Box>{{{0.4F, -1, 0.9F}, {2, 2, 1.1F}}});
  EXPECT_EQ(fraction_between_opposite(both), 0);
}

// Rays between two edges that are patches: they run along the top of a body, above it or through it.
TEST(VisibleFraction, IsThatOfRaysAlongAFaceToo) {
  const auto fraction_at = [](float height) {
    const PatchSet edges(
        std::vector<Vec3>{
            {0, 0, height}, {0, 1, height}, {0, 1, height}, {4, 0, height}, {4, 1, height}, {4, 1, height}},
        std::vector<std::size_t>{0, 3, 6}, PatchSides::both);
    Occluders body;
    body.add_solid_hulls(
        std::vector<Vec3>{
            {1, -1, 0}, {3, -1, 0}, {3, 2, 0}, {1, 2, 0}, {1, -1, 1}, {2.5F, -1, 1}, {2.5F, 2, 1}, {1, 2, 1}},
        std::vector<std::size_t>{0, 8});
    return fractions_of(edges, edges, body, {{0, 1}})[0];
  };
  EXPECT_EQ(fraction_at(0.5F), 0);
  EXPECT_EQ(fraction_at(1), 1);
  EXPECT_EQ(fraction_at(1.25F), 1);
  EXPECT_EQ(fraction_at(-0.25F), 1);
}

TEST(VisibleFraction, CountsNoRayThatLeavesOrArrivesBehind) {
  const PatchSet away(
      std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}},
      std::vector<std::size_t>{0, 4, 8});
  EXPECT_EQ(fractions_of(away, away, {}, {{0, 1}})[0], 0);
  const PatchSet both_sides = opposite(PatchSides::both);
  EXPECT_EQ(fractions_of(both_sides, both_sides, {}, {{0, 1}})[0], 1);
  EXPECT_EQ(fractions_of(away, both_sides, {}, {{0, 1}})[0], 0);
  // Half of the square stands below the floor. What rises above it sees all of it that it faces.
  const PatchSet sunk(
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, -1}, {2, 0, 1}, {2, 1, 1}, {2, 1, -1}},
      std::vector<std::size_t>{0, 4, 8});
  EXPECT_EQ(fractions_of(sunk, sunk, {}, {{0, 1}})[0], 1);
}

// How near to a patch something blocks depends on the extent of the scene more than on where it is.
TEST(VisibleFraction, IsHalfBehindHalfAWallFarFromTheOriginToo) {
  constexpr float far = 100000;
  const auto at = [](float x, float y, float z) { return Vec3{far + x, far + y, z}; };
  const PatchSet patches(std::vector<Vec3>{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 0.25F),
                                           at(0, 1, 0.25F), at(1, 1, 0.25F), at(1, 0, 0.25F)},
                         std::vector<std::size_t>{0, 4, 8});
  Occluders wall;
  wall.add_polygons(std::vector<Vec3>{at(-1, -1, 0.125F), at(0.5F, -1, 0.125F), at(0.5F, 2, 0.125F), at(-1, 2, 0.125F)},
                    one_of_four);
  EXPECT_NEAR(fractions_of(patches, patches, wall, {{0, 1}}, {.rays = 4096})[0], 0.5, 0.01);
}

// What a patch lies on is not between it and another one.
TEST(VisibleFraction, IsNotLessForTheSurfacesThatPatchesLieOn) {
  for (const float far : {0.0F, 1000.0F}) {
    for (const double angle : {0.0, 0.3, 1.1}) {
      const auto turned = [&](Vec3 p) {
        const double x = p[0] * std::cos(angle) - p[2] * std::sin(angle);
        const double z = p[0] * std::sin(angle) + p[2] * std::cos(angle);
        return Vec3{static_cast<float>(x) + far, p[1] + far, static_cast<float>(z)};
      };
      std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}};
      std::vector<Triangle> triangles;
      for (Vec3& corner : corners) corner = turned(corner);
      for (const float z : {0.0F, 2.0F}) {
        const Vec3 p[4] = {turned({-1, -1, z}), turned({3, -1, z}), turned({3, 3, z}), turned({-1, 3, z})};
        triangles.push_back({{p[0], p[1], p[2]}});
        triangles.push_back({{p[0], p[2], p[3]}});
      }
      const PatchSet patches(corners, std::vector<std::size_t>{0, 4, 8});
      Occluders walls;
      walls.add_triangles(TriangleStream(triangles).view());
      EXPECT_EQ(fractions_of(patches, patches, walls, {{0, 1}}, {.tolerance = 2e-4F})[0], 1) << angle << ", " << far;
      // The box that a patch is a side of does not hide it from what is in front.
      if (angle != 0) continue;
      Occluders bodies;
      bodies.add_solids(
          std::vector<Box>{{{far, far, -1}, {far + 1, far + 1, 0}}, {{far, far, 2}, {far + 1, far + 1, 3}}});
      EXPECT_EQ(fractions_of(patches, patches, bodies, {{0, 1}})[0], 1) << far;
    }
  }
}

/// A scene of everything there is, not in line with anything.
struct MixedScene {
  std::vector<Vec3> corners;
  PatchSet patches;
  Occluders occluders;
  std::size_t count = 0;

  [[nodiscard]] std::span<const Vec3> patch(std::size_t i) const { return std::span(corners).subspan(3 * i, 3); }

  explicit MixedScene(std::uint64_t seed) {
    Random random(seed);
    std::vector<std::size_t> first{0};
    for (std::size_t i = 0; i != 24; ++i) {
      const Vec3 at = random.vec3(-3, 3);
      const auto near = [&] {
        const Vec3 way = random.vec3(-0.4F, 0.4F);
        return Vec3{at[0] + way[0], at[1] + way[1], at[2] + way[2]};
      };
      for (std::size_t c = 0; c != 3; ++c) corners.push_back(near());
      first.push_back(corners.size());
    }
    patches = PatchSet(corners, first);
    count = first.size() - 1;
    std::vector<Box> solids;
    for (std::size_t i = 0; i != 6; ++i) solids.push_back(random.box(-2, 2, 0.2F, 1.5F));
    occluders.add_solids(solids);
    std::vector<Vec3> hulls;
    std::vector<Vec3> polygons;
    std::vector<std::size_t> first_of_hulls{0};
    std::vector<std::size_t> first_of_polygons{0};
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i != 6; ++i) {
      const Vec3 at = random.vec3(-2, 2);
      const auto near = [&] {
        const Vec3 way = random.vec3(-1, 1);
        return Vec3{at[0] + way[0], at[1] + way[1], at[2] + way[2]};
      };
      for (std::size_t c = 0; c != 7; ++c) hulls.push_back(near());
      first_of_hulls.push_back(hulls.size());
      for (std::size_t c = 0; c != 3; ++c) polygons.push_back(near());
      first_of_polygons.push_back(polygons.size());
      triangles.push_back({{near(), near(), near()}});
    }
    occluders.add_solid_hulls(hulls, first_of_hulls);
    occluders.add_polygons(polygons, first_of_polygons);
    occluders.add_triangles(TriangleStream(triangles).view());
  }
};

TEST(VisibleFraction, IsAllOfClearPairsAndNoneOfOccludedOnes) {
  std::size_t clear = 0;
  std::size_t occluded = 0;
  for (std::uint64_t seed = 1; seed != 60; ++seed) {
    const MixedScene scene(seed);
    std::vector<PatchPair> pairs;
    std::vector<Sight> sights;
    visibility(scene.patches, scene.occluders, [&](const SightBatch& batch) {
      for (const PairBlock& block : batch.blocks) {
        for (const std::uint32_t i : scene.patches.order().subspan(block.a.first, block.a.count)) {
          for (const std::uint32_t j : scene.patches.order().subspan(block.b.first, block.b.count)) {
            pairs.push_back({i, j});
            sights.push_back(block.sight);
          }
        }
      }
    });
    const std::vector<float> fractions = fractions_of(scene.patches, scene.patches, scene.occluders, pairs);
    for (std::size_t i = 0; i != pairs.size(); ++i) {
      const bool is_clear = sights[i] == Sight::clear;
      if (is_clear && fractions[i] == 0) {  // hardly any segment leaves and arrives in front
        EXPECT_LT(view_factor(scene.patch(pairs[i].a), scene.patch(pairs[i].b)), 1e-4);
        continue;
      }
      EXPECT_EQ(fractions[i], is_clear ? 1 : 0) << seed << ": " << pairs[i].a << ", " << pairs[i].b;
      (is_clear ? clear : occluded) += sights[i] == Sight::facing_away ? 0 : 1;
    }
  }
  EXPECT_GT(clear, 100U);
  EXPECT_GT(occluded, 100U);
}

TEST(VisibleFraction, IsTheSameBitsOnEveryInstructionSetAndOneByOne) {
  const MixedScene scene(7);
  std::vector<PatchPair> pairs;
  for (std::uint32_t i = 0; i != scene.count; ++i) {
    for (std::uint32_t j = 0; j != i; ++j) pairs.push_back({i, j});
  }
  for (const RayOptions& options : {RayOptions{}, RayOptions{.rays = 1}, RayOptions{.rays = 200, .error = 0.05}}) {
    const std::vector<float> right = fractions_of(scene.patches, scene.patches, scene.occluders, pairs, options);
    std::size_t partly = 0;
    for (const float fraction : right) partly += fraction > 0 && fraction < 1 ? 1 : 0;
    EXPECT_GT(partly, 10U);
    on_each_instruction_set([&] {
      EXPECT_EQ(fractions_of(scene.patches, scene.patches, scene.occluders, pairs, options), right);
      for (std::size_t i = 0; i < pairs.size(); i += 17) {
        EXPECT_EQ(fractions_of(scene.patches, scene.patches, scene.occluders, {pairs[i]}, options)[0], right[i]);
      }
    });
  }
}

TEST(VisibleFraction, NeedsCandidatesOnly) {
  const MixedScene scene(9);
  const Visibility all = collect_visibility(scene.patches, scene.occluders);
  ASSERT_GT(all.undecided.size(), 20U);
  std::vector<float> fractions(all.undecided.size());
  visible_fractions(scene.patches, scene.patches, scene.occluders, {all.undecided, all.first_candidate, all.candidates},
                    fractions);
  EXPECT_EQ(fractions, fractions_of(scene.patches, scene.patches, scene.occluders, all.undecided));
}

TEST(VisibleFraction, GetsFewerRaysForALargerError) {
  const MixedScene scene(7);
  const std::vector<PatchPair> pairs = collect_visibility(scene.patches, scene.occluders).undecided;
  const std::vector<float> exact = fractions_of(scene.patches, scene.patches, scene.occluders, pairs, {.rays = 65536});
  const std::vector<float> rough =
      fractions_of(scene.patches, scene.patches, scene.occluders, pairs, {.rays = 65536, .error = 0.02});
  EXPECT_NE(exact, rough);
  for (std::size_t i = 0; i != pairs.size(); ++i) EXPECT_NEAR(exact[i], rough[i], 0.15) << i;
}

TEST(VisibleFraction, RefusesWhatHasNone) {
  const PatchSet patches = opposite();
  Occluders occluders;
  occluders.add_polygons(half, one_of_four);
  const std::vector<PatchPair> pair{{0, 1}};
  const std::vector<std::size_t> first{0, 1};
  const std::vector<std::uint32_t> candidates{0};
  std::vector<float> fractions(1);
  const auto refused = [&](const UndecidedPairs& pairs, const RayOptions& options = {}) {
    return message_of([&] { visible_fractions(patches, patches, occluders, pairs, fractions, options); });
  };
  EXPECT_THAT(refused({pair, {}, {}}), HasSubstr("first_candidate has 0 positions for 1 pair"));
  const std::vector<PatchPair> beyond{{0, 2}};
  EXPECT_EQ(refused({beyond, first, candidates}), "pair 0 is of patches 0 and 2; there are 2 and 2");
  const std::vector<std::uint32_t> no_such{1};
  EXPECT_EQ(refused({pair, first, no_such}), "pair 0 has candidate 1; there are 1 occluder");
  const std::vector<std::size_t> too_far{0, 2};
  EXPECT_EQ(refused({pair, too_far, candidates}), "pair 0 has candidates that do not lie in `candidates`");
  EXPECT_EQ(refused({pair, first, candidates}, {.rays = 0}), "rays is 0; a pair gets 1 to 65536");
  EXPECT_THAT(refused({pair, first, candidates}, {.error = -0.5}), HasSubstr("error is -0.5"));
  EXPECT_THAT(refused({pair, first, candidates}, {.tolerance = std::numeric_limits<float>::infinity()}),
              HasSubstr("tolerance is inf"));
  fractions.resize(2);
  EXPECT_EQ(refused({pair, first, candidates}), "fractions has 2 elements for 1 pair");
  fractions.resize(1);
  const PatchSet solid(std::vector<Box>{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}});
  EXPECT_THAT(message_of([&] {
                visible_fractions(solid, solid, occluders, {pair, first, candidates}, fractions);
              }),
              HasSubstr("is a box that is not flat"));
}

}  // namespace
}  // namespace shaftcull
