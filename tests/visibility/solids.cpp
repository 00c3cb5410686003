// SPDX-License-Identifier: MIT
/// Larger boxes out of many, and boxes inside hulls, against exact arithmetic.
#include "shaftcull/solids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "oracle/convex_hull.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull {
namespace {

bool holds(const Box& outer, const Box& inner) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  }
  return true;
}

/// Whether some box holds a point whose coordinates are given as twice a number of the coordinates' list, or between
/// two of them: so everything between coordinates is sampled, and flat boxes, too.
bool covers(const std::vector<Box>& boxes, const std::array<std::vector<float>, 3>& coordinates,
            const std::array<std::size_t, 3>& cell) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) {
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t at = cell[k] / 2;
      const float lo = coordinates[k][at];
      const float hi = coordinates[k][at + cell[k] % 2];  // the same, or the next one
      if (lo < box.lo[k] || hi > box.hi[k]) return false;
    }
    return true;
  });
}

/// Fails unless both cover the same cells, edges and corners of the grid of their coordinates.
void expect_same_union(const std::vector<Box>& a, const std::vector<Box>& b) {
  std::array<std::vector<float>, 3> coordinates;
  for (std::size_t k = 0; k != 3; ++k) {
    for (const auto* boxes : {&a, &b}) {
      for (const Box& box : *boxes) {
        coordinates[k].push_back(box.lo[k]);
        coordinates[k].push_back(box.hi[k]);
      }
    }
    std::sort(coordinates[k].begin(), coordinates[k].end());
    coordinates[k].erase(std::unique(coordinates[k].begin(), coordinates[k].end()), coordinates[k].end());
  }
  for (std::size_t x = 0; x + 1 < 2 * coordinates[0].size(); ++x) {
    for (std::size_t y = 0; y + 1 < 2 * coordinates[1].size(); ++y) {
      for (std::size_t z = 0; z + 1 < 2 * coordinates[2].size(); ++z) {
        ASSERT_EQ(covers(a, coordinates, {x, y, z}), covers(b, coordinates, {x, y, z}));
      }
    }
  }
}

TEST(MergedBoxes, CoverWhatTheGivenOnesCoverAndNoneIsInAnother) {
  for (std::uint64_t seed = 1; seed <= random_cases(1500); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Box> boxes;
    const int reach = random.one_in(2) ? 2 : 4;
    for (unsigned left = 1 + random.below(14); left != 0; --left) {
      Box box = random.grid_box(0, reach);
      if (random.one_in(3)) {
        for (std::size_t k = 0; k != 3; ++k) box.hi[k] = box.lo[k] + 1;
      }
      for (float& x : box.lo) {
        if (x == 0 && random.one_in(2)) x = -0.0F;
      }
      boxes.push_back(box);
    }
    const std::vector<Box> merged = merged_boxes(boxes);
    expect_same_union(boxes, merged);
    for (std::size_t i = 0; i != merged.size(); ++i) {
      for (std::size_t j = 0; j != merged.size(); ++j) ASSERT_FALSE(i != j && holds(merged[j], merged[i]));
    }
    // Every box given is whole in one of the result, and so are two that make one box.
    const auto is_in_one = [&](const Box& box) {
      return std::any_of(merged.begin(), merged.end(), [&](const Box& one) { return holds(one, box); });
    };
    for (const Box& box : boxes) ASSERT_TRUE(is_in_one(box));
    for (const Box& box : merged) {
      for (const Box& other : merged) {
        for (std::size_t axis = 0; axis != 3; ++axis) {
          Box both = box;
          both.hi[axis] = other.hi[axis];
          const std::size_t i = (axis + 1) % 3;
          const std::size_t j = (axis + 2) % 3;
          const bool are_alike = box.lo[i] == other.lo[i] && box.hi[i] == other.hi[i] && box.lo[j] == other.lo[j] &&
                                 box.hi[j] == other.hi[j];
          if (are_alike && box.lo[axis] <= other.lo[axis] && other.lo[axis] <= box.hi[axis]) {
            ASSERT_TRUE(is_in_one(both));
          }
        }
      }
    }
    // In whatever order they come, and again.
    std::reverse(boxes.begin(), boxes.end());
    ASSERT_EQ(merged_boxes(boxes), merged);
    ASSERT_EQ(merged_boxes(merged), merged);
  }
}

TEST(MergedBoxes, WallsThatCrossAreBothWhole) {
  // Each in five pieces, and the piece in the middle is that of both.
  std::vector<Box> pieces;
  for (int i = 0; i != 5; ++i) {
    const auto at = static_cast<float>(i);
    pieces.push_back({{at, 2, 0}, {at + 1, 3, 3}});
    pieces.push_back({{2, at, 0}, {3, at + 1, 3}});
  }
  const std::vector<Box> merged = merged_boxes(pieces);
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0], (Box{{0, 2, 0}, {5, 3, 3}}));
  EXPECT_EQ(merged[1], (Box{{2, 0, 0}, {3, 5, 3}}));
}

TEST(MergedBoxes, AreNotMadeOfBoxesAnUlpApart) {
  const float beside = std::nextafter(1.0F, 2.0F);
  const std::vector<Box> apart{{{0, 0, 0}, {1, 1, 1}}, {{beside, 0, 0}, {2, 1, 1}}};
  EXPECT_EQ(merged_boxes(apart).size(), 2U);
  const std::vector<Box> higher{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, beside}}};
  EXPECT_EQ(merged_boxes(higher).size(), 2U);
}

TEST(MergedBoxes, MakeThousandsOfPiecesOne) {
  std::vector<Box> pieces;
  for (int i = 0; i != 4096; ++i) {
    const int row = i / 16;
    const int layer = row / 16;
    const auto x = static_cast<float>(i % 16);
    const auto y = static_cast<float>(row % 16);
    const auto z = static_cast<float>(layer);
    pieces.push_back({{x, y, z}, {x + 1, y + 1, z + 1}});
  }
  EXPECT_EQ(merged_boxes(pieces), (std::vector<Box>{{{0, 0, 0}, {16, 16, 16}}}));
}

/// What is said of two boxes between which these are solid.
Sight sight_past(const Box& a, const Box& b, const std::vector<Box>& solids, bool solids_around_ends) {
  Occluders occluders;
  occluders.add_solids(solids);
  const SightCounts counts =
      count_visibility(PatchSet(std::span<const Box>(&a, 1)), PatchSet(std::span<const Box>(&b, 1)), occluders,
                       {.solids_around_ends = solids_around_ends});
  return counts.occluded != 0 ? Sight::occluded : counts.clear != 0 ? Sight::clear : Sight::undecided;
}

TEST(Solids, BlockAloneWhatTheyDoWhateverElseIsSolid) {
  struct Case {
    const char* what;
    Box a;
    Box b;
    Box blocks;  ///< alone
    Box other;
    bool solids_around_ends;
  };
  const Box near{{0, 0.4F, 0.4F}, {0.1F, 0.6F, 0.6F}};
  const Box far{{9, 0.4F, 0.4F}, {9.5F, 0.6F, 0.6F}};
  const Box flat{{0, 0, 0}, {0, 1, 0}};
  const Box flat_far{{9, 0, 0}, {9, 1, 0}};
  const Box corner{{1, 1, 1}, {1, 1, 1}};
  for (const Case& it : {
           Case{"a wall within a thicker one that holds an end",
                near,
                far,
                {{1, 0, 0}, {2, 1, 1}},
                {{-1, -1, -1}, {3, 2, 2}},
                false},
           Case{"a piece of a wall whose other piece holds an end",
                near,
                far,
                {{1, 0, 0}, {2, 1, 1}},
                {{-1, 0, 0}, {1, 1, 1}},
                false},
           Case{"a flat solid in the face of a thick one",
                flat,
                flat_far,
                {{4, -1, 0}, {5, 2, 0}},
                {{4, -1, 0}, {5, 2, 3}},
                true},
           Case{"a point in the corner of a thick one", corner, corner, corner, {{1, 1, 1}, {2, 2, 2}}, true},
       }) {
    SCOPED_TRACE(it.what);
    EXPECT_EQ(sight_past(it.a, it.b, {it.blocks}, it.solids_around_ends), Sight::occluded);
    EXPECT_NE(sight_past(it.a, it.b, {it.other}, it.solids_around_ends), Sight::occluded);
    EXPECT_EQ(sight_past(it.a, it.b, {it.blocks, it.other}, it.solids_around_ends), Sight::occluded);
    EXPECT_EQ(sight_past(it.a, it.b, {it.other, it.blocks}, it.solids_around_ends), Sight::occluded);
  }
}

TEST(Solids, AndPatchesThatWereMovedFromAreNone) {
  const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{4, 0, 0}, {5, 1, 1}}};
  Occluders from;
  from.add_solids(boxes);
  const Occluders to = std::move(from);
  EXPECT_EQ(to.size(), 2U);
  EXPECT_EQ(from.size(), 0U);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move): as tested
  const Occluders copy = from;
  EXPECT_EQ(copy.size(), 0U);
  PatchSet patches(boxes);
  const PatchSet taken = std::move(patches);
  EXPECT_EQ(taken.size(), 2U);
  EXPECT_EQ(patches.size(), 0U);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  EXPECT_FALSE(patches.has_planes());
  EXPECT_EQ(count_visibility(patches, from), SightCounts{});
  EXPECT_EQ(count_visibility(taken, from), (SightCounts{.clear = 1}));
  EXPECT_EQ(from.add_solids(boxes), 0U);
  EXPECT_EQ(from.size(), 2U);
  patches = taken;
  EXPECT_EQ(patches.size(), 2U);
}

double volume(const Box& box) {
  double product = 1;
  for (std::size_t k = 0; k != 3; ++k) product *= double{box.hi[k]} - double{box.lo[k]};
  return product;
}

/// Corners of a box with half extents `half`, turned by two angles and moved.
std::vector<Vec3> turned_box(const std::array<double, 3>& half, double about_z, double about_x, const Vec3& middle) {
  std::vector<Vec3> corners;
  for (unsigned c = 0; c != 8; ++c) {
    std::array<double, 3> p{};
    for (unsigned k = 0; k != 3; ++k) p[k] = (c >> k & 1U) != 0 ? half[k] : -half[k];
    const double x = std::cos(about_z) * p[0] - std::sin(about_z) * p[1];
    const double y = std::sin(about_z) * p[0] + std::cos(about_z) * p[1];
    const double up = std::sin(about_x) * y + std::cos(about_x) * p[2];
    const double along = std::cos(about_x) * y - std::sin(about_x) * p[2];
    corners.push_back(
        {middle[0] + static_cast<float>(x), middle[1] + static_cast<float>(along), middle[2] + static_cast<float>(up)});
  }
  return corners;
}

/// The largest volume of an upright box around the middle of a turned one, of all proportions in steps of 4 %. What
/// lies within is what lies within three slabs.
double best_volume(const std::array<double, 3>& half, double about_z, double about_x) {
  const double slab[3][3] = {
      {std::cos(about_z), std::sin(about_z) * std::cos(about_x), std::sin(about_z) * std::sin(about_x)},
      {-std::sin(about_z), std::cos(about_z) * std::cos(about_x), std::cos(about_z) * std::sin(about_x)},
      {0, -std::sin(about_x), std::cos(about_x)}};
  double best = 0;
  for (double y = 1.0 / 64; y < 64; y *= 1.04) {
    for (double z = 1.0 / 64; z < 64; z *= 1.04) {
      double growth = 1e300;
      for (std::size_t s = 0; s != 3; ++s) {
        growth =
            std::min(growth, half[s] / (std::fabs(slab[s][0]) + std::fabs(slab[s][1]) * y + std::fabs(slab[s][2]) * z));
      }
      best = std::max(best, 8 * growth * growth * growth * y * z);
    }
  }
  return best;
}

TEST(InscribedBox, OfTurnedBoxesIsInsideAndNearlyAsLargeAsCanBe) {
  double least = 1;
  for (std::uint64_t seed = 1; seed <= random_cases(60); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::array<double, 3> half{};
    for (double& x : half) x = double{random.uniform(0.5F, 5)};
    const double about_z = double{random.uniform(0, 3.2F)};
    const double about_x = seed % 2 == 0 ? 0 : double{random.uniform(0, 3.2F)};
    const std::vector<Vec3> corners = turned_box(half, about_z, about_x, random.vec3(-100, 100));
    const Box box = inscribed_box(corners);
    EXPECT_EQ(oracle::ConvexHull(corners).answer(box), Answer::inside);
    const double share = volume(box) / best_volume(half, about_z, about_x);
    least = std::min(least, share);
    EXPECT_GT(share, 0.6);
  }
  RecordProperty("least_share", std::to_string(least));
}

TEST(InscribedBox, OfAnyHullIsInside) {
  for (std::uint64_t seed = 1; seed <= random_cases(400); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Vec3> corners;
    const unsigned kind = random.below(5);
    for (unsigned left = 4 + random.below(7); left != 0; --left) {
      Vec3 corner = random.vec3(-1, 1);
      if (kind == 0) corner[random.below(3)] = 0.25F;
      if (kind == 1) corner[2] = corner[0];  // flat, aslant
      if (kind == 2) corner = {random.integer(0, 2), random.integer(0, 2), random.integer(0, 2)};
      if (kind == 3) {
        for (float& x : corner) x = std::ldexp(x, static_cast<int>(seed % 200) - 130);
      }
      corners.push_back(corner);
    }
    const Box box = inscribed_box(corners);
    for (std::size_t k = 0; k != 3; ++k) ASSERT_LE(box.lo[k], box.hi[k]);
    ASSERT_EQ(oracle::ConvexHull(corners).answer(box), Answer::inside);
    if (kind == 1) {
      EXPECT_EQ(volume(box), 0);
    }
  }
}

TEST(InscribedBox, OfABoxIsTheBox) {
  for (std::uint64_t seed = 1; seed <= random_cases(200); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Vec3 p{};
    Vec3 q{};
    for (float& x : p) x = random.wild(-60, 60);
    for (float& x : q) x = random.wild(-60, 60);
    const Box box = seed % 2 == 0 ? random.box(-100, 100, 0, 20) : Random::sorted(p, q);
    std::vector<Vec3> corners;
    for (unsigned c = 0; c != 8; ++c) {
      Vec3 corner{};
      for (unsigned k = 0; k != 3; ++k) corner[k] = (c >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
      corners.push_back(corner);
    }
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(seed % 8), corners.end());
    corners.push_back({box.lo[0], box.hi[1], box.lo[2]});  // a corner twice
    EXPECT_EQ(inscribed_box(corners), box);
  }
}

TEST(InscribedBox, OfAPointOrAFlatHullIsOneOfItsCorners) {
  EXPECT_EQ(inscribed_box(std::vector<Vec3>(4, Vec3{1, 2, 3})), (Box{{1, 2, 3}, {1, 2, 3}}));
  const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 1}, {0, 1, 0}, {1, 1, 1}};
  const Box box = inscribed_box(flat);
  EXPECT_EQ(box.lo, box.hi);
  EXPECT_NE(std::find(flat.begin(), flat.end(), box.lo), flat.end());
}

}  // namespace
}  // namespace shaftcull
