// SPDX-License-Identifier: MIT
/// Every pair of random scenes is what it is said to be, on every instruction set.
#include "oracle/sight_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

/// Of all scenes together, so that a test that only asks for one kind of answer is noticed.
SightCounts seen;

/// Adds so many occluders of each kind to a scene that the library puts them into clumps, few of which come near a
/// shaft. Most are flat, many of these in a plane with a patch.
void add_crowd(SightScene& scene, std::uint64_t seed) {
  Random random(seed);
  const auto draw = [&] {
    Box box{};
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = random.integer(-4, 36);
      box.hi[k] = box.lo[k] + random.integer(0, 2);
    }
    const unsigned flat = random.below(4);
    if (flat == 3) return box;
    if (random.one_in(2)) box.lo[flat] = scene.a[random.below(static_cast<unsigned>(scene.a.size()))].lo[flat];
    box.hi[flat] = box.lo[flat];
    return box;
  };
  for (unsigned left = 600; left != 0; --left) scene.boxes.push_back(draw());
  for (unsigned left = 600; left != 0; --left) scene.solids.push_back(draw());
  for (unsigned left = 60; left != 0; --left) {
    const Box box = draw();
    for (const Vec3& corner : {box.lo, Vec3{box.hi[0], box.lo[1], box.hi[2]}, box.hi}) {
      scene.polygon_corners.push_back(corner);
    }
    scene.first_polygon.push_back(scene.polygon_corners.size());
  }
}

/// What is done to a scene.
enum class Change { none, crowd, corners, sides_and_corners, corners_seen_from_both_sides };

void expect_right(SightScenery scenery, std::uint64_t seeds, unsigned most_patches, std::uint64_t first_seed = 1,
                  Change change = Change::none) {
  for (std::uint64_t seed = first_seed; seed != first_seed + seeds; ++seed) {
    SCOPED_TRACE(std::string("random_sight_scene(") + name(scenery) + ", " + std::to_string(seed) + ", " +
                 std::to_string(most_patches) + ")" +
                 (change == Change::crowd                          ? " in a crowd"
                  : change == Change::corners                      ? " with corners"
                  : change == Change::sides_and_corners            ? " with sides of boxes, and corners"
                  : change == Change::corners_seen_from_both_sides ? " with corners, of both sides"
                                                                   : ""));
    SightScene scene = random_sight_scene(scenery, seed, most_patches);
    if (change == Change::crowd) add_crowd(scene, seed);
    const bool of_both_sides = change == Change::corners_seen_from_both_sides;
    if (change == Change::corners || of_both_sides) scene = with_corners(std::move(scene), seed);
    if (of_both_sides) scene.sides = PatchSides::both;
    if (change == Change::sides_and_corners) scene = with_corners(std::move(scene), seed, PolygonMix::sides_beside);
    const SightCase of(std::move(scene));
    const SightTruths truths(of);
    Visibility first;
    bool is_first = true;
    on_each_instruction_set([&] {
      const Visibility all = of.collect(of.options);
      ASSERT_EQ(truths.fault_of(all), "");
      EXPECT_EQ(of.count(of.options), all.counts);
      VisibilityOptions small = of.options;
      small.memory = std::size_t{1} << 20;
      small.candidates = seed % 2 == 0;
      ASSERT_EQ(truths.fault_of(of.collect(small), small.candidates), "");
      if (is_first) {
        first = all;
        is_first = false;
        return;
      }
      EXPECT_EQ(all.blocks, first.blocks);
      EXPECT_EQ(all.undecided, first.undecided);
      EXPECT_EQ(all.candidates, first.candidates);
    });
    for (const Sight sight : {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away}) {
      seen.of(sight) += first.counts.of(sight);
    }
    if (testing::Test::HasFailure()) return;
  }
}

/// A scene in one test is small, so that its oracle is quick; larger ones have groups of groups.
void expect_all_right(SightScenery scenery, std::uint64_t small, std::uint64_t large, Change change = Change::none) {
  seen = {};
  expect_right(scenery, random_cases(small), 24, 1, change);
  if (testing::Test::HasFailure()) return;
  const bool has_corners = change != Change::none && change != Change::crowd;
  expect_right(scenery, random_cases(large), has_corners ? 100 : 220, 1000, change);
  std::cout << name(scenery) << ": undecided " << seen.undecided << ", clear " << seen.clear << ", occluded "
            << seen.occluded << ", facing away " << seen.facing_away << "\n";
  EXPECT_GT(seen.undecided, random_cases(100));
  EXPECT_GT(seen.clear, random_cases(100));
  EXPECT_GT(seen.occluded, random_cases(20));
  EXPECT_GT(seen.facing_away, random_cases(change == Change::corners_seen_from_both_sides ? 5 : 100));
}

TEST(Visibility, IsWhatItIsInLattices) { expect_all_right(SightScenery::lattice, 60, 2); }
TEST(Visibility, IsWhatItIsOfPoints) { expect_all_right(SightScenery::points, 60, 3); }
TEST(Visibility, AnswersAreRightWhereAllIsFlat) { expect_all_right(SightScenery::flat, 60, 4); }
TEST(Visibility, IsWhatItIsOfBoxesInBoxes) { expect_all_right(SightScenery::nested, 30, 1); }
TEST(Visibility, IsWhatItIsInRooms) { expect_all_right(SightScenery::room, 60, 3); }
TEST(Visibility, IsWhatItIsOfRandomFloats) { expect_all_right(SightScenery::uniform, 50, 3); }
TEST(Visibility, IsWhatItIsOfIntegersAndFloatsBesideThem) { expect_all_right(SightScenery::nudged, 60, 3); }
TEST(Visibility, IsWhatItIsWhereOccludersTouchShafts) { expect_all_right(SightScenery::near_edges, 100, 4); }
TEST(Visibility, IsWhatItIsOfAnyMagnitude) { expect_all_right(SightScenery::wild, 70, 1); }
TEST(Visibility, IsWhatItIsOfDenormals) { expect_all_right(SightScenery::tiny, 80, 2); }
TEST(Visibility, IsWhatItIsUpToTheLargestFloat) { expect_all_right(SightScenery::huge, 100, 1); }

TEST(Visibility, IsRightForPolygonsInLattices) { expect_all_right(SightScenery::lattice, 50, 2, Change::corners); }
TEST(Visibility, IsRightForPolygonsWhereAllIsFlat) { expect_all_right(SightScenery::flat, 50, 2, Change::corners); }
TEST(Visibility, IsRightForPolygonsInRooms) { expect_all_right(SightScenery::room, 50, 2, Change::corners); }
TEST(Visibility, IsRightForPolygonsOfRandomFloats) { expect_all_right(SightScenery::uniform, 50, 2, Change::corners); }
TEST(Visibility, IsRightForPolygonsOfIntegersAndFloatsBesideThem) {
  expect_all_right(SightScenery::nudged, 50, 2, Change::corners);
}
TEST(Visibility, IsRightForPolygonsOfAnyMagnitude) { expect_all_right(SightScenery::wild, 28, 1, Change::corners); }
TEST(Visibility, IsRightForPolygonsOfDenormals) { expect_all_right(SightScenery::tiny, 30, 1, Change::corners); }
TEST(Visibility, IsRightForPolygonsUpToTheLargestFloat) {
  expect_all_right(SightScenery::huge, 30, 1, Change::corners);
}

// In some of these scenes the other set has boxes with planes.
TEST(Visibility, IsRightForPolygonsSeenFromBothSidesInLattices) {
  expect_all_right(SightScenery::lattice, 50, 2, Change::corners_seen_from_both_sides);
}
TEST(Visibility, IsRightForPolygonsSeenFromBothSidesInRooms) {
  expect_all_right(SightScenery::room, 50, 2, Change::corners_seen_from_both_sides);
}
TEST(Visibility, IsRightForPolygonsSeenFromBothSidesOfIntegersAndFloatsBesideThem) {
  expect_all_right(SightScenery::nudged, 50, 2, Change::corners_seen_from_both_sides);
}
TEST(Visibility, IsRightForPolygonsSeenFromBothSidesOfRandomFloats) {
  expect_all_right(SightScenery::uniform, 30, 2, Change::corners_seen_from_both_sides);
}

// Where two of a pair are the boxes around them, answers are those of boxes, whatever else is in their groups.
TEST(Visibility, IsRightForSidesOfBoxesBesidePolygonsInLattices) {
  expect_all_right(SightScenery::lattice, 50, 3, Change::sides_and_corners);
}
TEST(Visibility, IsRightForSidesOfBoxesBesidePolygonsInRooms) {
  expect_all_right(SightScenery::room, 50, 3, Change::sides_and_corners);
}
TEST(Visibility, IsRightForSidesOfBoxesBesidePolygonsOfRandomFloats) {
  expect_all_right(SightScenery::uniform, 30, 2, Change::sides_and_corners);
}

TEST(Visibility, IsWhatItIsAmongManyOccluders) {
  seen = {};
  expect_right(SightScenery::nudged, random_cases(40), 8, 1, Change::crowd);
  expect_right(SightScenery::flat, random_cases(300), 2, 1, Change::crowd);
  expect_right(SightScenery::nudged, 1, 80, 1000, Change::crowd);
  EXPECT_GT(seen.undecided, random_cases(100));
  EXPECT_GT(seen.clear, random_cases(20));
  EXPECT_GT(seen.occluded, random_cases(20));
}

// Flat boxes lie in the plane z = 0 of all patches, a thick one below each: so z = 0 is a face of every clump.
TEST(Visibility, IsWhatItIsInAFaceOfAClump) {
  constexpr int columns = 40;
  constexpr int rows = 20;
  std::vector<Box> boxes;
  for (int y = 0; y != rows; ++y) {
    for (int x = 0; x != columns; ++x) {
      const auto at_x = static_cast<float>(10 * x);
      const auto at_y = static_cast<float>(10 * y);
      boxes.push_back({{at_x, at_y, 0}, {at_x + 2, at_y + 2, 0}});
      boxes.push_back({{at_x, at_y, -2}, {at_x + 2, at_y + 2, 0}});
    }
  }
  Occluders occluders;
  occluders.add_boxes(std::span<const Box>(boxes));
  on_each_instruction_set([&] {
    for (int y = 0; y != rows; ++y) {
      const auto at_y = static_cast<float>(10 * y + 1);
      const Box left{{-1, at_y, 0}, {-1, at_y, 0}};
      const Box right{{500, at_y, 0}, {500, at_y, 0}};
      const Visibility all =
          collect_visibility(PatchSet(std::span(&left, 1)), PatchSet(std::span(&right, 1)), occluders);
      std::vector<std::uint32_t> expected;
      for (int x = 0; x != columns; ++x) expected.push_back(static_cast<std::uint32_t>(2 * (y * columns + x)));
      EXPECT_EQ(all.candidates, expected);
    }
  });
}

// Two solids are one box, whose middle hides some points from others; each of the two only touches what lies flat in
// their seam. So some groups of points have no occluder between them, and yet pairs that are occluded.
TEST(Visibility, IsOccludedInTheSeamOfTwoSolidsHoweverPatchesAreGrouped) {
  constexpr Box solids[] = {{{-1, -1, 0}, {1, 0, 10}}, {{-1, 0, 0}, {1, 1, 10}}};
  Occluders occluders;
  occluders.add_solids(std::span<const Box>(solids));
  for (const int count : {1, 2, 65, 1000}) {
    SCOPED_TRACE(std::to_string(count) + " points on each side");
    std::vector<Box> left;
    std::vector<Box> right;
    const auto z_of = [&](int i) { return 5 + (i % 2 == 0 ? i : -i) / 2; };
    for (int i = 0; i != count; ++i) {
      const auto z = static_cast<float>(z_of(i));
      left.push_back({{-3, 0, z}, {-3, 0, z}});
      right.push_back({{3, 0, z}, {3, 0, z}});
    }
    SightCounts expected;
    for (int i = 0; i != count; ++i) {
      for (int j = 0; j != count; ++j) {
        // Three times z where the segment enters and leaves -1 < x < 1.
        const int in = 2 * z_of(i) + z_of(j);
        const int out = z_of(i) + 2 * z_of(j);
        ++(std::max(in, out) > 0 && std::min(in, out) < 30 ? expected.occluded : expected.clear);
      }
    }
    ASSERT_EQ(expected.clear == 0, count <= 2);
    std::vector<Box> both = left;
    both.insert(both.end(), right.begin(), right.end());
    const PatchSet a{std::span<const Box>(left)};
    const PatchSet b{std::span<const Box>(right)};
    const PatchSet all{std::span<const Box>(both)};
    SightCounts of_all = expected;
    of_all.clear += static_cast<std::uint64_t>(count) * static_cast<std::uint64_t>(count - 1);  // on either side
    on_each_instruction_set([&] {
      for (const bool solids_around_ends : {true, false}) {
        VisibilityOptions options;
        options.solids_around_ends = solids_around_ends;
        EXPECT_EQ(count_visibility(a, b, occluders, options), expected);
        EXPECT_EQ(count_visibility(b, a, occluders, options), expected);
        EXPECT_EQ(count_visibility(all, occluders, options), of_all);
      }
    });
  }
}

// The planes that a set keeps depend on the tolerance and on the largest coordinate.
TEST(Visibility, OfAUsedSetIsThatOfANewOne) {
  constexpr Box far[] = {{{-1e6F, -1e6F, 9e5F}, {1e6F, 1e6F, 1e6F}}};
  Occluders elsewhere;
  elsewhere.add_boxes(std::span<const Box>(far));
  std::uint64_t differ = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(120); ++seed) {
    const auto scenery = static_cast<SightScenery>(seed % sight_sceneries);
    SCOPED_TRACE(std::string("random_sight_scene(") + name(scenery) + ", " + std::to_string(seed) + ", 40)");
    const SightCase used(random_sight_scene(scenery, seed, 40));
    VisibilityOptions tolerant = used.options;
    tolerant.tolerance += 0.25F;
    (void)count_visibility(used.a, used.b, elsewhere, tolerant);
    for (const VisibilityOptions& options : {used.options, tolerant, used.options}) {
      const SightCase fresh(random_sight_scene(scenery, seed, 40));
      EXPECT_EQ(used.count(options), fresh.count(options));
    }
    differ += used.count(tolerant) != used.count(used.options) ? 1 : 0;
  }
  EXPECT_GT(differ, 2U);
}

// Of a group, both a unit normal and a shorter one along the same axis: the shorter one's products round.
TEST(Visibility, IsNotTakenForFacingAwayWhereAGroupHasNormalsOfSeveralLengths) {
  expect_right(SightScenery::lattice, 1, 24, 118);
}

}  // namespace
}  // namespace shaftcull
