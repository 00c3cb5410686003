// SPDX-License-Identifier: MIT
/// The planes of cones in lanes: what they say for certain is what exact arithmetic says.
#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "corners_in_lanes.hpp"
#include "dispatch/active_kernels.hpp"
#include "exact/hull_cone.hpp"
#include "exact/hull_mesh.hpp"
#include "instruction_sets.hpp"
#include "sanitizers.hpp"
#include "shaftcull/visibility.hpp"
#include "solid_between_patches.hpp"
#include "visibility/cone_planes.hpp"

namespace shaftcull {
namespace {

using kernel::BehindCone;
using kernel::EndPoints;
using kernel::HullCone;
using kernel::HullMesh;
using kernel::most_siblings;

/// The planes of a cone as lanes read them, and the patches that it hides.
struct ConeInLanes {
  std::vector<kernel::ConePlane> planes;
  std::uint64_t hidden = 0;

  ConeInLanes(const SolidBetweenPatches& of, const HullMesh& mesh, EndPoints counting, float tolerance) {
    HullCone cone;
    cone.begin(mesh, of.fixed, counting, tolerance);
    cone.add_edges();
    for (const HullCone::Plane& plane : cone.planes()) {
      planes.push_back(kernel::plane_in_lanes(plane, counting, tolerance, of.coordinate()));
    }
    for (std::size_t lane = 0; lane != most_siblings; ++lane) {
      hidden |= std::uint64_t{cone.hides(of.others[lane])} << lane;
    }
  }
  [[nodiscard]] BehindCone behind(const CornersInLanes& lanes, std::uint64_t asked) const {
    return kernel::active_kernels().siblings.corners_behind_cone(planes.data(), planes.size(), lanes.stream(), 3,
                                                                 most_siblings, asked);
  }
};

TEST(ConesInLanes, AreCertainOfNothingElseThanTheExactCone) {
  std::uint64_t certain_in_all = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(600); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SolidBetweenPatches of(seed, 4 + seed % 20, 0);
    const HullMesh mesh(of.solid);
    if (!mesh.has_interior()) continue;
    const CornersInLanes lanes(of.others, 3);
    for (const EndPoints counting : {EndPoints::of_relative_interior, EndPoints::all}) {
      const ConeInLanes cone(of, mesh, counting, of.tolerance);
      on_each_instruction_set([&] {
        for (const std::uint64_t asked : {~std::uint64_t{0}, std::uint64_t{0x0123456789abcdef}}) {
          const BehindCone behind = cone.behind(lanes, asked);
          ASSERT_EQ((behind.possible | behind.certain) & ~asked, 0U);
          ASSERT_EQ(behind.certain & ~cone.hidden, 0U);
          ASSERT_EQ(cone.hidden & asked & ~behind.possible, 0U);
          certain_in_all += static_cast<std::uint64_t>(std::popcount(behind.certain));
        }
      });
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(certain_in_all, random_cases(1000));
}

/// A box on a floor, and triangles that stand on the floor, too: a plane across an axis leaves nothing to be decided.
TEST(ConesInLanes, AreCertainOfCornersInAPlaneAcrossAnAxis) {
  std::uint64_t flush_in_all = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SolidBetweenPatches of(seed, 2, 0);
    const auto height = [&](float above) { return (above + of.offset) * of.factor; };
    of.solid = corners_of_box_between({height(-1), height(-7), height(0)}, {height(1), height(7), height(9)});
    const auto triangle = [&](float x) -> std::vector<Vec3> {
      const auto y = [&] { return height(of.random.integer(-3, 3)); };
      const float bottom = y();
      return {{height(x), bottom, height(0)}, {height(x), bottom, height(2)}, {height(x), y(), height(0)}};
    };
    of.fixed = triangle(-10);
    for (std::vector<Vec3>& other : of.others) other = triangle(10);
    const HullMesh mesh(of.solid);
    const CornersInLanes lanes(of.others, 3);
    const ConeInLanes cone(of, mesh, EndPoints::of_relative_interior, 0);
    on_each_instruction_set([&] {
      const BehindCone behind = cone.behind(lanes, ~std::uint64_t{0});
      ASSERT_EQ(behind.certain, cone.hidden);
      ASSERT_EQ(behind.possible, behind.certain);
      flush_in_all += static_cast<std::uint64_t>(std::popcount(behind.certain));
    });
    if (HasFailure()) return;
  }
  EXPECT_GT(flush_in_all, random_cases(1000));
}

// A polygon that is not flat is the triangles that its first corner forms: each must part both patches.
TEST(VisibilityOfCorners, APolygonHidesAsAllOfItsTrianglesDo) {
  const std::vector<Vec3> corners{{0.4F, -0.6F, 3},  {0.4F, -0.4F, 3},  {0.6F, -0.4F, 3},  {0.6F, -0.6F, 3},
                                  {0.4F, -0.6F, -3}, {0.6F, -0.6F, -3}, {0.6F, -0.4F, -3}, {0.4F, -0.4F, -3}};
  const PatchSet patches(corners, std::vector<std::size_t>{0, 4, 8});
  const auto occluded = [&](float height) {
    Occluders folded;
    folded.add_polygons(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, height}},
                        std::vector<std::size_t>{0, 4});
    return count_visibility(patches, folded).occluded;
  };
  EXPECT_EQ(occluded(0), 1U);
  EXPECT_EQ(occluded(1), 1U);
  EXPECT_EQ(occluded(8), 0U) << "both patches are in front of the second triangle";
}

}  // namespace
}  // namespace shaftcull
