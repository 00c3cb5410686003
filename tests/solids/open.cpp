// SPDX-License-Identifier: MIT
/// Bodies that are open on or beyond a face of the region of all patches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/visibility.hpp"
#include "solids/found_in.hpp"
#include "solids/open_meshes.hpp"

namespace shaftcull {
namespace {

Box box_of(const Polygons& mesh) {
  std::vector<Vec3> vertices;
  for (const Triangle& triangle : mesh.triangles) {
    vertices.insert(vertices.end(), triangle.vertex.begin(), triangle.vertex.end());
  }
  return box_around(vertices);
}

/// The mesh with its axes in another order, and maybe mirrored in the origin. Faces keep their fronts.
Polygons with_axes(const Polygons& mesh, std::size_t shift, bool is_mirrored) {
  Polygons other = mesh;
  for (Triangle& triangle : other.triangles) {
    for (Vec3& v : triangle.vertex) {
      std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(shift), v.end());
      if (is_mirrored) v = {-v[0], -v[1], -v[2]};
    }
  }
  if (is_mirrored) other.flip();
  return other;
}

TEST(FoundSolids, AreBuildingsWithoutABottomOnTheGroundOfTheRegion) {
  for (const std::size_t shift : {0U, 1U, 2U}) {
    for (const bool is_mirrored : {false, true}) {
      SCOPED_TRACE(shift);
      const Polygons mesh = with_axes(city_on_level_ground(), shift, is_mirrored);
      const FoundSolids found = found_in(mesh, {.region = box_of(mesh)});
      ASSERT_EQ(counts(found), (Counts{4, 0, 0}));
      EXPECT_EQ(found.hull_corners.size(), 32U);
      EXPECT_EQ(found_in(mesh).hulls(), 0U);
      EXPECT_EQ(counts(found_in(mesh, {.bodies = false, .region = box_of(mesh)})), (Counts{0, 20, 0}));
    }
  }
  Polygons turned = city_on_level_ground();
  turned.turn(0.5, 0);
  const FoundSolids found = found_in(turned, {.region = box_of(turned)});
  ASSERT_EQ(found.hulls(), 4U);
  for (const Vec3& corner : found.hull_corners) EXPECT_TRUE(corner[2] == 0 || corner[2] >= 20);
}

TEST(FoundSolids, AreBuildingsOfAnyShapeOnTheGround) {
  Polygons mesh;
  mesh.add({{-9, -9, 0}, {99, -9, 0}, {99, 99, 0}, {-9, 99, 0}});
  mesh.add_box({{50, 50, 0}, {60, 60, 9}});  // its bottom lies on the ground
  mesh.add_l_block(0, 0, 0, 3);
  mesh.triangles.resize(mesh.triangles.size() - 4);  // its bottom
  mesh.add_column(20, 20, 5, 12, -1, 8);             // reaches below the ground, where it is open
  mesh.triangles.resize(mesh.triangles.size() - 10);
  mesh.add_l_block(30, 0, -1, 3);  // likewise
  mesh.triangles.resize(mesh.triangles.size() - 4);
  Box region = box_of(mesh);
  region.lo[2] = 0;
  const FoundSolids found = found_in(mesh, {.region = region});
  EXPECT_EQ(found.hulls(), 2U);
  EXPECT_EQ(found.hull_corners.size(), 8U + 24U);
  EXPECT_EQ(found.inner_boxes,
            (std::vector<Box>{
                {{0, 0, 0}, {2, 4, 3}}, {{0, 0, 0}, {4, 2, 3}}, {{30, 0, 0}, {32, 4, 3}}, {{30, 0, 0}, {34, 2, 3}}}));
  EXPECT_EQ(counts(found_in(mesh, {.region = {{-9, -9, -0.5F}, {99, 99, 9}}})), (Counts{2, 1 + 2 * (6 + 2), 2}));
}

TEST(FoundSolids, AreNoOpenBodiesThatAreNotClosedByTheGround) {
  const Box region{{-9, -9, 0}, {9, 9, 9}};
  const auto found_with = [&](const Polygons& mesh) { return counts(found_in(mesh, {.region = region})); };
  Polygons above;  // the ground
  add_open_box(above, {{0, 0, 1}, {2, 2, 3}});
  EXPECT_EQ(found_with(above), (Counts{0, 5, 0}));
  Polygons broken;
  add_open_box(broken, {{0, 0, 0}, {2, 2, 3}});
  broken.triangles.erase(broken.triangles.begin());
  EXPECT_EQ(found_with(broken).front(), 0U);
  Polygons open_at_both_ends;
  add_open_box(open_at_both_ends, {{0, 0, 0}, {2, 2, 9}});
  open_at_both_ends.triangles.resize(8);
  EXPECT_EQ(found_with(open_at_both_ends), (Counts{0, 4, 0}));
  Polygons room;
  add_open_box(room, {{0, 0, 0}, {2, 2, 3}});
  room.flip();
  EXPECT_EQ(found_with(room), (Counts{0, 5, 0}));
}

TEST(FoundSolids, AreNoOpenShellsAroundSomethingButOnFloors) {
  const Box region{{-9, -9, 0}, {9, 9, 9}};
  Polygons mesh;
  add_open_box(mesh, {{0, 0, 0}, {6, 5, 3}});
  Polygons with_a_table = mesh;
  with_a_table.add({{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}});
  EXPECT_EQ(counts(found_in(with_a_table, {.region = region})), (Counts{0, 6, 0}));
  Polygons with_a_floor = mesh;
  with_a_floor.add({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}});
  EXPECT_EQ(counts(found_in(with_a_floor, {.region = region})), (Counts{1, 0, 0}));
}

TEST(FoundSolids, AreBuildingsAtTheRimOfASmallGround) {
  // As many triangles stand on the face of the rim as on the ground.
  Polygons mesh;
  add_open_box(mesh, {{0, 0, 0}, {4, 4, 4}});
  mesh.add({{4, 0, 0}, {9, 0, 0}, {9, 4, 0}});
  for (const std::size_t shift : {0U, 1U, 2U}) {
    const Polygons other = with_axes(mesh, shift, false);
    EXPECT_EQ(counts(found_in(other, {.region = box_of(other)})), (Counts{1, 0, 0}));
  }
}

TEST(FoundSolids, AreFlushWallsAndSlabsOfARoomWithinItsRegion) {
  // Where triangles of the ground are left out, faces that touch must not join two bodies.
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {9, 5, 1}});
  mesh.add_box({{0, 0, 4}, {9, 5, 5}});
  mesh.add_box({{0, 0, 1}, {1, 5, 4}});
  mesh.add_box({{8, 0, 1}, {9, 5, 4}});
  mesh.add_box({{1, 0, 1}, {8, 1, 4}});
  mesh.add_box({{1, 4, 1}, {8, 5, 4}});
  EXPECT_EQ(counts(found_in(mesh)), (Counts{6, 0, 0}));
  EXPECT_EQ(counts(found_in(mesh, {.region = box_of(mesh)})), (Counts{6, 0, 0}));
}

TEST(FoundSolids, AreOpenBuildingsThatShareAWall) {
  // At the foot of the wall, two walls meet back to back, and no ground is between them.
  for (const float height : {6.0F, 8.0F}) {
    for (const double angle : {0.0, 0.5}) {
      Polygons mesh;
      add_open_box(mesh, {{0, 0, 0}, {4, 5, 6}});
      add_open_box(mesh, {{4, 0, 0}, {8, 5, height}});
      add_open_box(mesh, {{8, 0, 0}, {12, 5, 6}});
      mesh.turn(angle, 0);
      EXPECT_EQ(counts(found_in(mesh, {.region = {{-99, -99, 0}, {99, 99, 99}}})), (Counts{3, 0, 0}));
    }
  }
}

TEST(FoundSolids, AreInnerBoxesOfBodiesThatAreOpenOnAnySide) {
  Polygons mesh;
  mesh.add_l_block(1, 1, 0, 3);
  mesh.triangles.resize(mesh.triangles.size() - 4);
  for (const std::size_t shift : {0U, 1U, 2U}) {
    for (const bool is_mirrored : {false, true}) {
      Box region = SolidSearch{}.region;
      (is_mirrored ? region.hi : region.lo)[(2 + 3 - shift) % 3] = 0;
      const FoundSolids found = found_in(with_axes(mesh, shift, is_mirrored), {.region = region});
      EXPECT_EQ(found.inner_boxes.size(), 2U);
    }
  }
}

TEST(FoundSolids, AreNoOpenShellsAroundSomethingThatReachesBelowTheGround) {
  Polygons mesh;
  add_open_box(mesh, {{0, 0, 0}, {6, 5, 3}});
  mesh.add_box({{1, 1, -1}, {2, 2, 1}});
  for (const std::size_t shift : {0U, 1U, 2U}) {
    Box region{{-9, -9, -9}, {9, 9, 9}};
    region.lo[(2 + 3 - shift) % 3] = 0;
    const FoundSolids found = found_in(with_axes(mesh, shift, false), {.region = region});
    EXPECT_EQ(counts(found), (Counts{1, 5, 0}));
  }
}

TEST(FoundSolids, NeedARegionThatIsABox) {
  const float nan = std::nanf("");
  for (const Box& region : {Box{{0, 0, nan}, {1, 1, 1}}, Box{{0, 0, 0}, {1, nan, 1}}, Box{{0, 0, 1}, {1, 1, 0}}}) {
    EXPECT_THROW(static_cast<void>(found_in({}, {.region = region})), InvalidArgument);
  }
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {1, 1, 1}});
  add_open_box(mesh, {{5, 0, 0}, {6, 1, 2}});
  EXPECT_EQ(found_in(mesh, {.region = PatchSet().box()}).hulls(), 1U);
  EXPECT_EQ(found_in(mesh, {.region = {{9, 9, -5}, {10, 10, 5}}}).hulls(), 1U);
}

}  // namespace
}  // namespace shaftcull
