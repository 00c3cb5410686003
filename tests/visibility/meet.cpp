// SPDX-License-Identifier: MIT
/// Solids that certainly hide nothing of two patches, in lanes: the exact answer is never otherwise.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "corners_in_lanes.hpp"
#include "dispatch/active_kernels.hpp"
#include "exact/blocking.hpp"
#include "exact/hull_cone.hpp"
#include "exact/hull_mesh.hpp"
#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/geometry.hpp"
#include "solid_between_patches.hpp"
#include "visibility/box_row.hpp"
#include "visibility/own_faces.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/solid_bounds.hpp"

namespace shaftcull {
namespace {

using kernel::BoxRow;
using kernel::HullCone;
using kernel::HullMesh;
using kernel::most_siblings;

std::uint64_t meeting(const SolidBetweenPatches& of, const kernel::SolidBounds& bounds, const CornersInLanes& lanes,
                      std::uint64_t asked) {
  return kernel::active_kernels().siblings.may_meet_solid(
      bounds, of.fixed.data(), static_cast<unsigned>(of.fixed.size()), lanes.stream(), 3, most_siblings, asked);
}

TEST(SegmentsPastASolid, AreNeverThoseOfAPatchThatAHullHides) {
  std::uint64_t hidden_in_all = 0;
  std::uint64_t missed_in_all = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SolidBetweenPatches of(seed, 4 + seed % 20, 0);
    const HullMesh mesh(of.solid);
    if (!mesh.has_interior()) continue;
    HullCone cone;
    cone.begin(mesh, of.fixed, kernel::EndPoints::of_relative_interior, of.tolerance);
    cone.add_edges();
    std::uint64_t hidden = 0;
    for (std::size_t lane = 0; lane != most_siblings; ++lane) {
      hidden |= std::uint64_t{cone.hides(of.others[lane])} << lane;
    }
    const CornersInLanes lanes(of.others, 3);
    const kernel::SolidBounds bounds =
        kernel::solid_bounds(row_of(box_around(of.solid)), mesh.radius(), of.coordinate());
    on_each_instruction_set([&] {
      for (const std::uint64_t asked : {~std::uint64_t{0}, std::uint64_t{0x0123456789abcdef}}) {
        const std::uint64_t met = meeting(of, bounds, lanes, asked);
        ASSERT_EQ(met & ~asked, 0U);
        ASSERT_EQ(hidden & asked & ~met, 0U);
        missed_in_all += static_cast<std::uint64_t>(std::popcount(asked & ~met));
      }
    });
    if (HasFailure()) return;
    hidden_in_all += static_cast<std::uint64_t>(std::popcount(hidden));
  }
  EXPECT_GT(hidden_in_all, random_cases(1000));
  EXPECT_GT(missed_in_all, random_cases(300));
}

TEST(SegmentsPastASolid, AreNeverThoseOfAPatchThatABoxHides) {
  std::uint64_t hidden_in_all = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SolidBetweenPatches of(seed, 2, 0);
    if (of.random.one_in(4)) of.solid[1][of.random.below(3)] = of.solid[0][of.random.below(3)];
    const Box box = Random::sorted(of.solid[0], of.solid[1]);
    const float faces[6] = {box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]};
    std::uint64_t hidden = 0;
    for (std::size_t lane = 0; lane != most_siblings; ++lane) {
      hidden |= std::uint64_t{kernel::box_blocks(of.fixed, of.others[lane], faces)} << lane;
    }
    const CornersInLanes lanes(of.others, 3);
    const kernel::SolidBounds bounds = kernel::solid_bounds(row_of(box), 0x1p30, of.coordinate());
    on_each_instruction_set([&] { ASSERT_EQ(hidden & ~meeting(of, bounds, lanes, ~std::uint64_t{0}), 0U); });
    if (HasFailure()) return;
    hidden_in_all += static_cast<std::uint64_t>(std::popcount(hidden));
  }
  EXPECT_GT(hidden_in_all, random_cases(500));
}

TEST(SegmentsPastASolid, AreNotThoseThatPassJustInsideAnEdgeOfABox) {
  std::uint64_t hidden_in_all = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Box box = random.box(10, 20, 1, 4);
    // Through a point of an edge, from far away: rounding moves some of them inside and some past it.
    const Vec3 on_edge{box.lo[0], box.lo[1], random.uniform(box.lo[2], box.hi[2])};
    const Vec3 way{random.uniform(1, 2), -random.uniform(1, 2), random.uniform(-1, 1)};
    const auto at = [&](float t) {
      return Vec3{on_edge[0] + t * way[0], on_edge[1] + t * way[1], on_edge[2] + t * way[2]};
    };
    const std::vector<Vec3> fixed(3, at(-random.uniform(100, 1000)));
    std::vector<std::vector<Vec3>> others;
    while (others.size() != most_siblings) others.emplace_back(3, at(random.uniform(100, 1000)));
    const float faces[6] = {box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]};
    std::uint64_t hidden = 0;
    for (std::size_t lane = 0; lane != most_siblings; ++lane) {
      hidden |= std::uint64_t{kernel::box_blocks(fixed, others[lane], faces)} << lane;
    }
    const CornersInLanes lanes(others, 3);
    const kernel::SolidBounds bounds = kernel::solid_bounds(row_of(box), 0x1p30, 4096);
    on_each_instruction_set([&] {
      ASSERT_EQ(hidden & ~kernel::active_kernels().siblings.may_meet_solid(bounds, fixed.data(), 3, lanes.stream(), 3,
                                                                           most_siblings, ~std::uint64_t{0}),
                0U);
    });
    if (HasFailure()) return;
    hidden_in_all += static_cast<std::uint64_t>(std::popcount(hidden));
  }
  EXPECT_GT(hidden_in_all, random_cases(2000));
}

TEST(SegmentsPastASolid, MissABallInTheCornerOfItsBox) {
  std::vector<Vec3> ball;
  for (int i = 0; i != 12; ++i) {
    for (int j = 1; j != 6; ++j) {
      const double along = i * 0.5235987755982988;
      const double up = j * 0.5235987755982988;
      ball.push_back({static_cast<float>(std::sin(up) * std::cos(along)),
                      static_cast<float>(std::sin(up) * std::sin(along)), static_cast<float>(std::cos(up))});
    }
  }
  const HullMesh mesh(ball);
  const auto square = [](float x, float y) {
    return std::vector<Vec3>{{x, y, -5}, {x + 0.1F, y, -5}, {x, y + 0.1F, -5}};
  };
  const std::vector<Vec3> fixed{{0.8F, 0.8F, 5}, {0.9F, 0.8F, 5}, {0.8F, 0.9F, 5}};
  const CornersInLanes lanes({square(0.8F, 0.8F), square(-0.8F, -0.8F), square(3, 3)}, 3);
  const kernel::SolidBounds bounds = kernel::solid_bounds(row_of(box_around(ball)), mesh.radius(), 8);
  on_each_instruction_set([&] {
    // The first segments pass the ball, the second ones go through it, and the third ones miss even the box.
    EXPECT_EQ(kernel::active_kernels().siblings.may_meet_solid(bounds, fixed.data(), 3, lanes.stream(), 3, 3, 7), 2U);
  });
}

TEST(OwnFaces, AreInFrontOfNoPatchThatTheirHullHides) {
  std::uint64_t dropped_in_all = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SolidBetweenPatches of(seed, 4 + seed % 20, 0);
    const HullMesh mesh(of.solid);
    if (!mesh.has_interior()) continue;
    std::vector<Vec3> corners;
    std::vector<std::size_t> first{0};
    for (const std::vector<Vec3>& other : of.others) {
      corners.insert(corners.end(), other.begin(), other.end());
      first.push_back(corners.size());
    }
    const kernel::PatchTree tree(corners, first, PatchSides::front);
    kernel::OwnFacesCache cache;
    const BoxRow around = row_of(box_around(of.solid));
    const auto find = [&] { return cache.of(tree, 0, 64, 7, mesh, around, of.tolerance, of.coordinate()); };
    const kernel::OwnFaces* const own = find();
    ASSERT_EQ(own, find());
    if (own == nullptr) continue;
    HullCone cone;
    cone.begin(mesh, of.fixed, kernel::EndPoints::of_relative_interior, of.tolerance);
    cone.add_edges();
    on_each_instruction_set([&] {
      const std::uint64_t dropped = kernel::active_kernels().siblings.planes_behind_points(
          own->normal, own->limit, 64, of.fixed.data(), of.fixed.size(), own->lanes);
      ASSERT_EQ(dropped & ~own->lanes, 0U);
      for (unsigned lane = 0; lane != 64; ++lane) {
        const bool is_dropped = (dropped >> lane & 1U) != 0;
        ASSERT_FALSE(is_dropped && cone.hides(tree.corners_of(lane).all())) << "patch " << lane;
      }
      dropped_in_all += static_cast<std::uint64_t>(std::popcount(dropped));
    });
    if (HasFailure()) return;
  }
  EXPECT_GT(dropped_in_all, random_cases(50));
}

}  // namespace
}  // namespace shaftcull
