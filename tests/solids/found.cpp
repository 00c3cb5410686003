// SPDX-License-Identifier: MIT
/// What find_solids() finds in meshes of known kinds, and what pairs it makes occluded.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "caught.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/visibility.hpp"
#include "solids/meshes.hpp"

namespace shaftcull {
namespace {

FoundSolids found_in(const Polygons& mesh, const SolidSearch& search = {}) {
  return find_solids(TriangleStream(std::span<const Triangle>(mesh.triangles)), search);
}

std::vector<Vec3> hull(const FoundSolids& found, std::size_t i) {
  return {found.hull_corners.begin() + static_cast<std::ptrdiff_t>(found.first_hull_corner[i]),
          found.hull_corners.begin() + static_cast<std::ptrdiff_t>(found.first_hull_corner[i + 1])};
}

std::vector<Vec3> polygon(const FoundSolids& found, std::size_t i) {
  return {found.polygon_corners.begin() + static_cast<std::ptrdiff_t>(found.first_polygon_corner[i]),
          found.polygon_corners.begin() + static_cast<std::ptrdiff_t>(found.first_polygon_corner[i + 1])};
}

/// How many hulls, polygons and inner boxes there are.
using Counts = std::array<std::size_t, 3>;
Counts counts(const FoundSolids& found) { return {found.hulls(), found.polygons(), found.inner_boxes.size()}; }

/// The same mesh as it is, and turned so that all coordinates are rounded.
std::vector<Polygons> upright_and_turned(const Polygons& mesh) {
  std::vector<Polygons> both(3, mesh);
  both[1].turn(0.5, 0);
  both[2].turn(0.5, 0.7);
  return both;
}

TEST(FoundSolids, OfABoxAreItsEightCorners) {
  Polygons mesh;
  mesh.add_box({{-0.0F, 0, 0}, {1, 2, 3}});
  const FoundSolids found = found_in(mesh);
  ASSERT_EQ(counts(found), (Counts{1, 0, 0}));
  std::vector<Vec3> corners = hull(found, 0);
  std::sort(corners.begin(), corners.end());
  EXPECT_EQ(corners, (std::vector<Vec3>{
                         {0, 0, 0}, {0, 0, 3}, {0, 2, 0}, {0, 2, 3}, {1, 0, 0}, {1, 0, 3}, {1, 2, 0}, {1, 2, 3}}));
}

TEST(FoundSolids, OfATurnedBoxAreWithinAThousandthOfItsSize) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {10, 0.2F, 3}});
  for (const Polygons& it : upright_and_turned(mesh)) {
    const FoundSolids found = found_in(it);
    ASSERT_EQ(counts(found), (Counts{1, 0, 0}));
    const std::vector<Vec3> corners = hull(found, 0);
    ASSERT_EQ(corners.size(), 8U);
    for (const Vec3& corner : corners) {
      const bool is_near = std::any_of(it.triangles.begin(), it.triangles.end(), [&](const Triangle& triangle) {
        return std::any_of(triangle.vertex.begin(), triangle.vertex.end(), [&](const Vec3& vertex) {
          return std::hypot(corner[0] - vertex[0], corner[1] - vertex[1], corner[2] - vertex[2]) < 0.01F;
        });
      });
      EXPECT_TRUE(is_near);
    }
  }
}

TEST(FoundSolids, KeepHeightsOfABodyThatIsTurnedAboutAnUprightAxis) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {10, 0.2F, 3}});
  mesh.turn(0.5, 0);
  for (const Vec3& corner : found_in(mesh).hull_corners) EXPECT_TRUE(corner[2] == 0 || corner[2] == 3);
}

TEST(FoundSolids, AreColumnsWithAnyNumberOfSides) {
  for (const unsigned sides : {3U, 24U, 100U, 400U}) {
    SCOPED_TRACE(sides);
    Polygons mesh;
    mesh.add_column(5, 6, 1, sides, 0, 3);
    for (const Polygons& it : upright_and_turned(mesh)) {
      const FoundSolids found = found_in(it);
      EXPECT_EQ(counts(found), (Counts{1, 0, 0}));
      EXPECT_EQ(found.hull_corners.size(), std::min(2 * sides, 256U));
    }
  }
}

TEST(FoundSolids, AreTheSameHoweverFacesAreSplit) {
  Polygons mesh;
  for (int x = 0; x != 4; ++x) {
    for (int y = 0; y != 4; ++y) {
      const auto lo = [](int i) { return static_cast<float>(i) / 4; };
      const auto hi = [](int i) { return static_cast<float>(i + 1) / 4; };
      // The six faces of the unit cube, square by square.
      mesh.add({{lo(x), lo(y), 1}, {hi(x), lo(y), 1}, {hi(x), hi(y), 1}, {lo(x), hi(y), 1}});
      mesh.add({{lo(x), lo(y), 0}, {lo(x), hi(y), 0}, {hi(x), hi(y), 0}, {hi(x), lo(y), 0}});
      mesh.add({{lo(x), 0, lo(y)}, {hi(x), 0, lo(y)}, {hi(x), 0, hi(y)}, {lo(x), 0, hi(y)}});
      mesh.add({{lo(x), 1, lo(y)}, {lo(x), 1, hi(y)}, {hi(x), 1, hi(y)}, {hi(x), 1, lo(y)}});
      mesh.add({{0, lo(x), lo(y)}, {0, lo(x), hi(y)}, {0, hi(x), hi(y)}, {0, hi(x), lo(y)}});
      mesh.add({{1, lo(x), lo(y)}, {1, hi(x), lo(y)}, {1, hi(x), hi(y)}, {1, lo(x), hi(y)}});
    }
  }
  const FoundSolids found = found_in(mesh);
  EXPECT_EQ(counts(found), (Counts{1, 0, 0}));
  EXPECT_EQ(found.hull_corners.size(), 8U);
  const FoundSolids sheets = found_in(mesh, {.bodies = false});
  EXPECT_EQ(counts(sheets), (Counts{0, 6, 0}));
  EXPECT_EQ(sheets.polygon_corners.size(), 24U);
}

TEST(FoundSolids, OfAnLBlockAreBoxesInBothLegsAndItsFaces) {
  Polygons mesh;
  mesh.add_l_block(5, 0, 0, 3);
  const FoundSolids found = found_in(mesh);
  EXPECT_EQ(found.hulls(), 0U);
  EXPECT_EQ(found.inner_boxes, (std::vector<Box>{{{5, 0, 0}, {7, 4, 3}}, {{5, 0, 0}, {9, 2, 3}}}));
  EXPECT_GE(found.polygons(), 6U + 2 * 2);  // its top and its bottom are no convex polygons
  EXPECT_LE(found.polygons(), 6U + 2 * 3);
  mesh.turn(0.5, 0);
  const FoundSolids turned = found_in(mesh);
  EXPECT_EQ(turned.hulls(), 0U);
  EXPECT_GE(turned.inner_boxes.size(), 1U);
}

TEST(FoundSolids, AreNoBodiesOfABuildingWithoutABottom) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {4, 4, 6}});
  mesh.triangles.resize(mesh.triangles.size() - 2);
  for (const Polygons& it : upright_and_turned(mesh)) EXPECT_EQ(counts(found_in(it)), (Counts{0, 5, 0}));
}

/// A box without its bottom.
void add_open_box(Polygons& to, const Box& box) {
  to.add_box(box);
  to.triangles.resize(to.triangles.size() - 2);
}

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

/// Ground of 6 × 6 squares of 10 m, and four buildings without bottoms on it. Where they stand there is no ground, and
/// they share edges with the ground around them. One stands at the rim.
Polygons city_on_level_ground() {
  Polygons mesh;
  const auto is_built = [](int x, int y) { return (x == 1 || x == 5) && (y == 1 || y == 3); };
  for (int x = 0; x != 6; ++x) {
    for (int y = 0; y != 6; ++y) {
      const auto at_x = static_cast<float>(10 * x);
      const auto at_y = static_cast<float>(10 * y);
      if (is_built(x, y)) {
        add_open_box(mesh, {{at_x, at_y, 0}, {at_x + 10, at_y + 10, at_x + at_y}});
      } else {
        mesh.add({{at_x, at_y, 0}, {at_x + 10, at_y, 0}, {at_x + 10, at_y + 10, 0}, {at_x, at_y + 10, 0}});
      }
    }
  }
  return mesh;
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

TEST(FoundSolids, OfABaffleOfTwoTrianglesIsOnePolygon) {
  Polygons mesh;
  mesh.add({{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}});
  for (const Polygons& it : upright_and_turned(mesh)) {
    const FoundSolids found = found_in(it);
    EXPECT_EQ(counts(found), (Counts{0, 1, 0}));
    EXPECT_EQ(found.polygon_corners.size(), 4U);
  }
}

TEST(FoundSolids, OfAnyFloorAreConvexPolygons) {
  // A floor of 5 × 5 squares without the one in the middle: no convex polygon, so it is cut.
  Polygons mesh;
  for (int x = 0; x != 5; ++x) {
    for (int y = 0; y != 5; ++y) {
      if (x == 2 && y == 2) continue;
      const auto at_x = static_cast<float>(x);
      const auto at_y = static_cast<float>(y);
      mesh.add({{at_x, at_y, 0}, {at_x + 1, at_y, 0}, {at_x + 1, at_y + 1, 0}, {at_x, at_y + 1, 0}});
    }
  }
  const FoundSolids found = found_in(mesh);
  EXPECT_EQ(found.hulls(), 0U);
  EXPECT_LE(found.polygons(), 8U);
  double area = 0;
  for (std::size_t i = 0; i != found.polygons(); ++i) {
    const std::vector<Vec3> corners = polygon(found, i);
    for (std::size_t c = 0; c != corners.size(); ++c) {
      const Vec3& p = corners[c];
      const Vec3& q = corners[(c + 1) % corners.size()];
      area += (double{p[0]} * q[1] - double{p[1]} * q[0]) / 2;
    }
  }
  EXPECT_EQ(area, 24);
}

TEST(FoundSolids, AreNoRoomsButWhatStandsInThem) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {6, 5, 3}});
  mesh.flip();
  mesh.add_box({{1, 1, 0}, {2, 1.5F, 2}});
  for (const Polygons& it : upright_and_turned(mesh)) EXPECT_EQ(counts(found_in(it)), (Counts{1, 6, 0}));
}

TEST(FoundSolids, AreNoShellsAroundSomething) {
  Polygons mesh;
  mesh.add_box({{1, 1, 1}, {2, 2, 2}});
  Polygons shell = mesh;
  shell.add_box({{0, 0, 0}, {6, 5, 3}});
  EXPECT_EQ(counts(found_in(shell)), (Counts{1, 6, 0}));
  Polygons hollow = mesh;
  hollow.flip();
  hollow.add_box({{0, 0, 0}, {6, 5, 3}});
  EXPECT_EQ(counts(found_in(hollow)), (Counts{0, 12, 0}));
  Polygons l_shell = mesh;
  l_shell.add_l_block(0, 0, 0, 3);
  EXPECT_EQ(found_in(l_shell).inner_boxes.size(), 0U);
  // In the yard of the block, not in the block.
  Polygons yard;
  yard.add_box({{2.5F, 2.5F, 1}, {3, 3, 2}});
  yard.add_l_block(0, 0, 0, 3);
  EXPECT_EQ(found_in(yard).hulls(), 1U);
  EXPECT_EQ(found_in(yard).inner_boxes.size(), 2U);
}

TEST(FoundSolids, AreBodiesThatShareVerticesAndFaces) {
  Polygons row;
  for (int i = 0; i != 5; ++i) row.add_box({{static_cast<float>(i), 0, 0}, {static_cast<float>(i + 1), 1, 1}});
  EXPECT_EQ(counts(found_in(row)), (Counts{5, 0, 0}));
  Polygons block;
  for (int i = 0; i != 27; ++i) {
    const int layer = i / 9;
    const int column = i / 3 % 3;
    const Vec3 lo{static_cast<float>(i % 3), static_cast<float>(column), static_cast<float>(layer)};
    block.add_box({lo, {lo[0] + 1, lo[1] + 1, lo[2] + 1}});
  }
  EXPECT_EQ(counts(found_in(block)), (Counts{27, 0, 0}));
}

TEST(FoundSolids, OfATurnedCityInOneMeshAreItsBuildings) {
  Polygons mesh;
  for (int i = 0; i != 100; ++i) {
    const auto x = static_cast<float>(30 * (i % 10));
    const int row = i / 10;
    const auto y = static_cast<float>(30 * row);
    mesh.add_box({{x, y, 0}, {x + 20, y + 15, static_cast<float>(10 + i * 7 % 40)}});
  }
  mesh.add({{-30, -30, 0}, {330, -30, 0}, {330, 330, 0}, {-30, 330, 0}});
  for (const Polygons& it : upright_and_turned(mesh)) EXPECT_EQ(counts(found_in(it)), (Counts{100, 1, 0}));
}

TEST(FoundSolids, DoNotDependOnDuplicatesOfTriangles) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {1, 1, 1}});
  const FoundSolids once = found_in(mesh);
  for (std::size_t i = 0; i != 12; ++i) mesh.triangles.push_back(mesh.triangles[i]);
  mesh.triangles.push_back({{{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}}}});
  EXPECT_EQ(found_in(mesh), once);
}

TEST(FoundSolids, NarrowerThanTheLeastWidthAreLeftOut) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {1, 1, 1}});
  mesh.add_box({{5, 0, 0}, {5.1F, 0.1F, 3}});
  mesh.add({{0, 5, 0}, {4, 5, 0}, {4, 5, 3}, {0, 5, 3}});
  mesh.add({{0, 6, 0}, {4, 6, 0}, {4, 6, 0.1F}, {0, 6, 0.1F}});
  mesh.add_l_block(0, 10, 0, 0.1F);
  mesh.add_l_block(0, 20, 0, 3);
  const FoundSolids all = found_in(mesh);
  const FoundSolids wide = found_in(mesh, {.least_width = 0.5});
  EXPECT_EQ(all.hulls(), 2U);
  EXPECT_EQ(wide.hulls(), 1U);
  EXPECT_EQ(all.inner_boxes.size(), 4U);
  EXPECT_EQ(wide.inner_boxes.size(), 4U);
  EXPECT_EQ(all.polygons(), wide.polygons() + 1 + 6);  // the last one, and the sides of the flat block
  EXPECT_EQ(counts(found_in(mesh, {.least_width = 100})), (Counts{0, 0, 0}));
}

TEST(FoundSolids, OfNothingAreNone) {
  EXPECT_EQ(found_in({}), FoundSolids{});
  Polygons flat;  // there and back
  flat.add({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  flat.add({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}});
  EXPECT_EQ(counts(found_in(flat)), (Counts{0, 2, 0}));
  Polygons line;
  line.add({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  EXPECT_EQ(found_in(line), FoundSolids{});
}

TEST(FoundSolids, AreTheSameOfAMeshAndOfItsTriangles) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, {9, 9, 9}};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  Polygons mesh;
  mesh.add(std::span(vertices).first(4));
  EXPECT_EQ(find_solids(mesh_view(vertices, indices)), found_in(mesh));
}

TEST(FoundSolids, AreNotLookedForInBadTriangles) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {1, 1, 1}});
  mesh.triangles[7].vertex[1][2] = std::numeric_limits<float>::quiet_NaN();
  const auto error = caught<BadBound>([&] { static_cast<void>(found_in(mesh)); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->index(), 7U);
  const std::vector<Vec3> vertices{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}};
  const std::vector<std::uint32_t> indices{0, 1, 3};
  EXPECT_THROW(static_cast<void>(find_solids(mesh_view(vertices, indices))), InvalidArgument);
  for (const float width : {-1.0F, std::nanf("")}) {
    EXPECT_THROW(static_cast<void>(found_in({}, {.least_width = width})), InvalidArgument);
  }
}

/// How many pairs of these patches have each answer, with a mesh between them that is asked for solids.
SightCounts sights(const std::vector<Box>& patches, const Polygons& mesh) {
  const TriangleStream triangles{std::span<const Triangle>(mesh.triangles)};
  Occluders occluders;
  occluders.add_triangles(triangles);
  const std::size_t size = occluders.size();
  occluders.add_found(find_solids(triangles));
  EXPECT_EQ(occluders.size(), size);
  return count_visibility(PatchSet(patches), occluders);
}

TEST(FoundSolids, MakePairsOccluded) {
  const std::vector<Box> two{{{-0.5F, -5, 1}, {0.5F, -5, 2}}, {{-0.5F, 5, 1}, {0.5F, 5, 2}}};
  Polygons baffle;
  baffle.add({{-3, 0, 0}, {3, 0, 0}, {3, 0, 3}, {-3, 0, 3}});
  EXPECT_EQ(sights(two, baffle), (SightCounts{.occluded = 1}));
  Polygons column;
  column.add_column(0, 0, 2, 100, 0, 3);
  EXPECT_EQ(sights(two, column), (SightCounts{.occluded = 1}));
  Polygons block;
  block.add_l_block(-1, -1, 0, 3);
  EXPECT_EQ(sights(two, block), (SightCounts{.occluded = 1}));
  Polygons beside;
  beside.add_box({{4, -1, 0}, {6, 1, 3}});
  EXPECT_EQ(sights(two, beside), (SightCounts{.clear = 1}));
  Polygons thin;
  thin.add_box({{-0.1F, -1, 0}, {0.1F, 1, 3}});
  EXPECT_EQ(sights(two, thin), (SightCounts{.undecided = 1}));
}

TEST(FoundSolids, AreAddedByTheHundred) {
  std::vector<Box> patches;
  Polygons fences;
  for (int i = 0; i != 40; ++i) {
    for (int j = 0; j != 15; ++j) {
      const auto x = static_cast<float>(20 * i);
      const auto y = static_cast<float>(20 * j);
      fences.add({{x, y + 5, 0}, {x + 6, y + 5, 0}, {x + 6, y + 5, 6}, {x, y + 5, 6}});
      if (i < 8) {
        patches.push_back({{x + 2, y + 4, 2}, {x + 4, y + 4, 4}});
        patches.push_back({{x + 2, y + 6, 2}, {x + 4, y + 6, 4}});
      }
    }
  }
  const TriangleStream triangles{std::span<const Triangle>(fences.triangles)};
  const FoundSolids found = find_solids(triangles);
  ASSERT_EQ(found.polygons(), 600U);
  Occluders apart;  // as occluders of their own
  apart.add_triangles(triangles);
  apart.add_polygons(found.polygon_corners, found.first_polygon_corner);
  Occluders together;
  together.add_triangles(triangles);
  together.add_found(found);
  const PatchSet set(patches);
  const SightCounts counts = count_visibility(set, together);
  EXPECT_EQ(counts, count_visibility(set, apart));
  EXPECT_GE(counts.occluded, 120U);
}

TEST(FoundSolids, ThatAreBrokenAddNothing) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {1, 1, 1}});
  mesh.add({{0, 5, 0}, {4, 5, 0}, {4, 5, 3}, {0, 5, 3}});
  const std::vector<Box> two{{{0.4F, -5, 0.4F}, {0.6F, -5, 0.6F}}, {{0.4F, 3, 0.4F}, {0.6F, 3, 0.6F}}};
  const FoundSolids good = found_in(mesh);
  FoundSolids broken = good;
  broken.inner_boxes.push_back({{1, 0, 0}, {0, 1, 1}});
  Occluders occluders;
  EXPECT_THROW(occluders.add_found(broken), BadBound);
  broken = good;
  broken.polygon_corners[2][1] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(occluders.add_found(broken), BadBound);
  broken = good;
  broken.first_hull_corner.back() = 7;
  EXPECT_THROW(occluders.add_found(broken), InvalidArgument);
  if (!failed_calls_undo) return;
  EXPECT_EQ(count_visibility(PatchSet(two), occluders), (SightCounts{.clear = 1}));
  occluders.add_found(good);
  EXPECT_EQ(count_visibility(PatchSet(two), occluders), (SightCounts{.occluded = 1}));
}

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
