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
#include "shaftcull/solids.hpp"
#include "shaftcull/visibility.hpp"
#include "solids/found_in.hpp"
#include "solids/meshes.hpp"

namespace shaftcull {
namespace {

std::vector<Vec3> polygon(const FoundSolids& found, std::size_t i) {
  return {found.polygon_corners.begin() + static_cast<std::ptrdiff_t>(found.first_polygon_corner[i]),
          found.polygon_corners.begin() + static_cast<std::ptrdiff_t>(found.first_polygon_corner[i + 1])};
}

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

}  // namespace
}  // namespace shaftcull
