// SPDX-License-Identifier: MIT
/// Occluders of a mesh: groups of triangles, and boxes in place of the triangles that lie on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "caught.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/visibility.hpp"
#include "solids/found_in.hpp"
#include "solids/open_meshes.hpp"

namespace shaftcull {
namespace {

/// The facets of a mesh as patches, each of which faces its front.
PatchSet facets_of(const Polygons& mesh) {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (const Triangle& triangle : mesh.triangles) {
    corners.insert(corners.end(), triangle.vertex.begin(), triangle.vertex.end());
    first.push_back(corners.size());
  }
  return PatchSet(corners, first);
}

TEST(MeshOccluders, AreBoxesInPlaceOfTheirTrianglesAndGroupsOfOthers) {
  Polygons mesh = city_on_level_ground();
  mesh.add_column(45, 45, 3, 8, 0, 9);
  mesh.add({{30, 0, 5}, {30, 8, 5}, {30, 8, 9}, {30, 0, 9}});
  const TriangleStream triangles{std::span<const Triangle>(mesh.triangles)};
  const PatchSet patches = facets_of(mesh);
  Occluders occluders;
  occluders.add_boxes(std::vector<Box>{{{-9, -9, -9}, {-8, -8, -8}}});
  ASSERT_EQ(occluders.add_mesh(triangles, {.region = patches.box()}), 1U);
  std::vector<bool> is_in_group(triangles.size(), false);
  std::vector<Box> boxes;
  for (std::size_t i = 1; i != occluders.size(); ++i) {
    if (occluders.triangles(i).empty()) boxes.push_back(occluders.box(i));
    for (const std::uint32_t triangle : occluders.triangles(i)) {
      EXPECT_TRUE(boxes.empty()) << "groups come first";
      EXPECT_FALSE(is_in_group[triangle]);
      is_in_group[triangle] = true;
    }
  }
  ASSERT_EQ(boxes.size(), 4U);
  for (std::size_t i = 0; i != triangles.size(); ++i) {
    const Box around = box_around(mesh.triangles[i].vertex);
    EXPECT_NE(is_in_group[i],
              std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return joined(box, around) == box; }));
  }
  // They hide what the found solids hide, and are in the way where the triangles are.
  Occluders apart;
  apart.add_triangles(triangles);
  apart.add_found(find_solids(triangles, {.region = patches.box()}));
  EXPECT_EQ(count_visibility(patches, occluders), count_visibility(patches, apart));
}

TEST(MeshOccluders, OfAnOpenBuildingHideMoreThanItsWalls) {
  // Two patches at opposite corners of a building: segments between them enter through two of its walls.
  Polygons mesh;
  add_open_box(mesh, {{0, 0, 0}, {10, 10, 10}});
  const TriangleStream triangles{std::span<const Triangle>(mesh.triangles)};
  const PatchSet patches(std::vector<Box>{{{-3, -3, 0}, {-2, -2, 1}}, {{12, 12, 0}, {13, 13, 1}}});
  EXPECT_EQ(patches.box(), (Box{{-3, -3, 0}, {13, 13, 1}}));
  const auto counted = [&](const SolidSearch& search) {
    Occluders occluders;
    occluders.add_mesh(triangles, search);
    return count_visibility(patches, occluders);
  };
  EXPECT_EQ(counted({}).undecided, 1U);
  EXPECT_EQ(counted({.region = patches.box()}).occluded, 1U);
}

TEST(MeshOccluders, OfBadTrianglesAreNotAdded) {
  std::vector<float> coordinates(9, 0);
  coordinates.push_back(std::numeric_limits<float>::quiet_NaN());
  TriangleView triangles{};
  for (std::size_t k = 0; k != 9; ++k) triangles.stream[k] = coordinates.data() + (k == 8 ? 8 : 0);
  triangles.count = 2;
  Occluders occluders;
  const auto error = caught<BadBound>([&] { occluders.add_mesh(triangles); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->index(), 1U);
  triangles.count = 1;
  EXPECT_TRUE(caught<InvalidArgument>([&] { occluders.add_mesh(triangles, {.least_width = -1}); }).has_value());
  EXPECT_EQ(occluders.size(), 0U);
}

TEST(FoundBoxes, AreTakenFromOtherBodies) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {1, 2, 3}});
  Polygons turned;
  turned.add_box({{10, 0, 0}, {11, 2, 3}});
  turned.turn(0.5, 0);
  mesh.triangles.insert(mesh.triangles.end(), turned.triangles.begin(), turned.triangles.end());
  mesh.add({{0.25F, 0.25F, 3}, {0.75F, 0.25F, 3}, {0.75F, 1, 3}});  // on the first box
  mesh.add({{0.25F, 0.25F, 3}, {5, 0.25F, 3}, {5, 1, 3}});          // touches it
  const TriangleStream triangles{std::span<const Triangle>(mesh.triangles)};
  FoundSolids found = find_solids(triangles);
  ASSERT_EQ(found.hulls(), 2U);
  const FoundBoxes boxes = take_boxes(found, triangles.view());
  EXPECT_EQ(boxes.boxes, (std::vector<Box>{{{0, 0, 0}, {1, 2, 3}}}));
  EXPECT_EQ(found.hulls(), 1U);
  EXPECT_GT(hull(found, 0).front()[0], 5);
  std::vector<std::uint32_t> of_triangle(12, 0);
  of_triangle.resize(24, FoundBoxes::none);
  of_triangle.push_back(0);
  of_triangle.push_back(FoundBoxes::none);
  EXPECT_EQ(boxes.box_of_triangle, of_triangle);
  EXPECT_TRUE(take_boxes(found, triangles.view()).boxes.empty());
}

TEST(FoundBoxes, AreNotThoseIntoWhichSomethingReaches) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {9, 9, 1}});     // a slab
  mesh.add_box({{2, 2, 0.5F}, {3, 3, 4}});  // a wall that is sunk into it
  mesh.add_box({{20, 0, 0}, {21, 2, 3}});
  const TriangleStream triangles{std::span<const Triangle>(mesh.triangles)};
  FoundSolids found = find_solids(triangles);
  ASSERT_EQ(found.hulls(), 3U);
  // The slab's face goes through the wall.
  EXPECT_EQ(take_boxes(found, triangles.view()).boxes, (std::vector<Box>{{{20, 0, 0}, {21, 2, 3}}}));
  EXPECT_EQ(found.hulls(), 2U);
}

}  // namespace
}  // namespace shaftcull
