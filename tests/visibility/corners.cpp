// SPDX-License-Identifier: MIT
/// Patches with corners: walls at any angle are seen as axis-parallel ones are.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "caught.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

using Point = std::array<double, 3>;

/// Walls of squares, and one group of triangles per wall.
struct Walls {
  std::vector<Point> corners;  ///< four of each square
  std::vector<std::size_t> first_square;

  /// n × m squares that fill the parallelogram from a corner along two sides. They face u × v.
  void add(const Point& from, const Point& u, const Point& v, int n, int m) {
    first_square.push_back(corners.size() / 4);
    const auto at = [&](int i, int j) {
      Point p{};
      for (std::size_t k = 0; k != 3; ++k) p[k] = from[k] + u[k] * i / n + v[k] * j / m;
      return p;
    };
    for (int i = 0; i != n; ++i) {
      for (int j = 0; j != m; ++j) {
        for (const Point& p : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}) corners.push_back(p);
      }
    }
  }

  /// Turned about an axis through the origin: Rodrigues' formula.
  [[nodiscard]] Walls turned(double angle, const Point& about) const {
    const double length = std::hypot(about[0], about[1], about[2]);
    const Point e{about[0] / length, about[1] / length, about[2] / length};
    Walls walls = *this;
    for (Point& p : walls.corners) {
      const double along = (e[0] * p[0] + e[1] * p[1] + e[2] * p[2]) * (1 - std::cos(angle));
      const Point q = p;
      for (std::size_t k = 0; k != 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        p[k] = q[k] * std::cos(angle) + (e[i] * q[j] - e[j] * q[i]) * std::sin(angle) + e[k] * along;
      }
    }
    return walls;
  }

  [[nodiscard]] std::vector<Vec3> rounded() const {
    std::vector<Vec3> to;
    for (const Point& p : corners) {
      to.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
    return to;
  }
  [[nodiscard]] PatchSet patches(PatchSides sides = PatchSides::front) const {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i <= corners.size(); i += 4) first.push_back(i);
    return PatchSet(std::span<const Vec3>(rounded()), std::span<const std::size_t>(first), sides);
  }
  [[nodiscard]] Occluders occluders() const {
    const std::vector<Vec3> at = rounded();
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i != at.size(); i += 4) {
      triangles.push_back({{at[i], at[i + 1], at[i + 2]}});
      triangles.push_back({{at[i], at[i + 2], at[i + 3]}});
    }
    std::vector<std::size_t> first;
    for (const std::size_t square : first_square) first.push_back(2 * square);
    first.push_back(triangles.size());
    Occluders occluders;
    occluders.add_triangles(TriangleStream(std::span<const Triangle>(triangles)).view(), first);
    return occluders;
  }
};

constexpr Point skew{1, 2, 3};

/// Much more than rounding moves a plane, and much less than a patch is wide.
VisibilityOptions tolerant() {
  VisibilityOptions options;
  options.tolerance = 0x1p-14F;
  return options;
}

/// A cube that faces inwards.
Walls cube(double size, int squares) {
  const double s = size;
  Walls walls;
  walls.add({0, 0, 0}, {s, 0, 0}, {0, s, 0}, squares, squares);
  walls.add({0, 0, s}, {0, s, 0}, {s, 0, 0}, squares, squares);
  walls.add({0, 0, 0}, {0, s, 0}, {0, 0, s}, squares, squares);
  walls.add({s, 0, 0}, {0, 0, s}, {0, s, 0}, squares, squares);
  walls.add({0, 0, 0}, {0, 0, s}, {s, 0, 0}, squares, squares);
  walls.add({0, s, 0}, {s, 0, 0}, {0, 0, s}, squares, squares);
  return walls;
}

/// An L-shaped room out of three unit cubes, n × n squares per unit, which faces inwards.
Walls room_with_corner(int n) {
  Walls walls;
  for (const double z : {0.0, 1.0}) {
    for (const Point& from : {Point{0, 0, z}, Point{1, 0, z}, Point{0, 1, z}}) {
      if (z == 0) walls.add(from, {1, 0, 0}, {0, 1, 0}, n, n);
      if (z == 1) walls.add(from, {0, 1, 0}, {1, 0, 0}, n, n);
    }
  }
  walls.add({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, n, 2 * n);
  walls.add({2, 0, 0}, {0, 0, 1}, {0, 1, 0}, n, n);
  walls.add({2, 1, 0}, {0, 0, 1}, {-1, 0, 0}, n, n);
  walls.add({1, 1, 0}, {0, 0, 1}, {0, 1, 0}, n, n);
  walls.add({1, 2, 0}, {0, 0, 1}, {-1, 0, 0}, n, n);
  walls.add({0, 2, 0}, {0, 0, 1}, {0, -2, 0}, n, 2 * n);
  return walls;
}

TEST(VisibilityOfCorners, PatchesOfOneLeaningWallFaceAway) {
  Walls wall;
  wall.add({0, 0, 0}, {1, 0, 1}, {0, 1, 0}, 24, 1);
  const PatchSet patches = wall.patches();
  on_each_instruction_set([&] {
    const SightCounts counts = count_visibility(patches, wall.occluders(), tolerant());
    EXPECT_EQ(counts.facing_away, 276U);
    EXPECT_EQ(counts.total(), 276U);
  });
}

TEST(VisibilityOfCorners, TrianglesOfOneLeaningSquareFaceAwayWithoutATolerance) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 1, 0}};
  const std::vector<std::size_t> first{0, 3, 6};
  const PatchSet patches{std::span<const Vec3>(corners), std::span<const std::size_t>(first)};
  on_each_instruction_set([&] { EXPECT_EQ(count_visibility(patches, Occluders()).facing_away, 1U); });
}

TEST(VisibilityOfCorners, EveryPairInACubeIsDecidedHoweverTheCubeIsTurned) {
  const Walls straight = cube(2, 4);
  const SightCounts expected{
      .undecided = 0, .clear = 6 * 5 / 2 * 16 * 16, .occluded = 0, .facing_away = 6 * 16 * 15 / 2};
  on_each_instruction_set([&] {
    EXPECT_EQ(count_visibility(straight.patches(), straight.occluders()), expected);
    for (const Point& about : {Point{0, 0, 1}, skew}) {
      const Walls turned = straight.turned(0.5, about);
      EXPECT_EQ(count_visibility(turned.patches(), turned.occluders(), tolerant()), expected);
    }
  });
}

TEST(VisibilityOfCorners, ATurnedRoomWithACornerHasTheAnswersOfTheRoom) {
  const Walls straight = room_with_corner(8);
  const Walls turned = straight.turned(0.5, skew);
  ASSERT_EQ(straight.patches().size(), 896U);
  const SightCounts expected = count_visibility(straight.patches(), straight.occluders());
  on_each_instruction_set([&] {
    const SightCounts counts = count_visibility(turned.patches(), turned.occluders(), tolerant());
    EXPECT_GE(static_cast<double>(counts.clear), 0.95 * static_cast<double>(expected.clear));
    EXPECT_EQ(counts.facing_away, expected.facing_away);
  });
}

TEST(VisibilityOfCorners, PolygonsThatAreTheirBoxesAreAnsweredAsBoxesWithPlanes) {
  const Walls walls = room_with_corner(2);
  const PatchSet polygons = walls.patches();
  const std::vector<Vec3> at = walls.rounded();
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  for (std::size_t i = 0; i != at.size(); i += 4) {
    boxes.push_back(box_around(std::span(at).subspan(i, 4)));
    Plane plane{};
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t p = (k + 1) % 3;
      const std::size_t q = (k + 2) % 3;
      const float twice =
          (at[i + 1][p] - at[i][p]) * (at[i + 2][q] - at[i][q]) - (at[i + 1][q] - at[i][q]) * (at[i + 2][p] - at[i][p]);
      plane.normal[k] = twice > 0 ? 1.0F : twice < 0 ? -1.0F : 0.0F;
      plane.offset += plane.normal[k] * at[i][k];
    }
    planes.push_back(plane);
  }
  const PatchSet with_planes{std::span<const Box>(boxes), planes};
  const Visibility expected = collect_visibility(with_planes, walls.occluders());
  const Visibility all = collect_visibility(polygons, walls.occluders());
  EXPECT_EQ(all.counts, expected.counts);
  EXPECT_EQ(all.blocks, expected.blocks);
  EXPECT_EQ(all.undecided, expected.undecided);
  EXPECT_EQ(all.candidates, expected.candidates);
}

// Squares in a row, each turned by half a radian against the last: boxes around them overlap, they do not.
TEST(VisibilityOfCorners, PatchesOfBothSidesAreSeenFromBothAndHideByTheirCorners) {
  Walls walls;
  walls.add({0, 0, 0}, {4, 0, 4}, {0, 4, 0}, 1, 1);
  walls.add({4, 0, 0}, {4, 0, 4}, {0, 4, 0}, 1, 1);
  walls.add({8, 0, 0}, {4, 0, 4}, {0, 4, 0}, 1, 1);
  Occluders occluders;  // the one in the middle
  occluders.add_polygons(std::vector<Vec3>{{3, -9, -1}, {13, -9, 9}, {13, 9, 9}, {3, 9, -1}},
                         std::vector<std::size_t>{0, 4});
  const SightCounts without = count_visibility(walls.patches(PatchSides::both), Occluders());
  EXPECT_EQ(without.clear, 3U);
  const SightCounts with = count_visibility(walls.patches(PatchSides::both), occluders);
  EXPECT_EQ(with.occluded, 1U);  // the first and the last
  EXPECT_EQ(with.clear, 2U);     // the one in the middle lies in the polygon
  EXPECT_EQ(count_visibility(walls.patches(), Occluders()).facing_away, 3U);
}

/// Two leaning walls across each other, and one of patches upright in the first: their patches run round either way.
void expect_walls_face_away(int size, float tolerance) {
  const double across = size;
  Walls walls;
  walls.add({0, 0, 0}, {across, 0, across}, {0, across, 0}, size, size);
  walls.add({100, 0, 0}, {0, across, 0}, {-across, 0, across}, size, size);
  walls.add({101, 0, 1}, {4, 4, 0}, {0, 0, 4}, 4, 4);
  const PatchSet patches = walls.patches(PatchSides::both);
  const auto end = static_cast<float>(size);
  Occluders occluders;  // the first wall, and what is behind the second
  occluders.add_polygons(std::vector<Vec3>{{0, 0, 0}, {end, 0, end}, {end, end, end}, {0, end, 0}},
                         std::vector<std::size_t>{0, 4});
  occluders.add_boxes(std::vector<Box>{{{60, 0, 0}, {100, end, end}}});
  const std::uint64_t wall = static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(size);
  VisibilityOptions options;
  options.tolerance = tolerance;
  EXPECT_EQ(count_visibility(patches, Occluders(), options).facing_away, wall * (wall - 1) + 16 * 15 / 2);
  EXPECT_EQ(count_visibility(patches, occluders, options).facing_away, wall * (wall - 1) + 16 * 15 / 2);
  EXPECT_EQ(count_visibility(patches, patches, Occluders(), options).facing_away, 2 * wall * wall + 16 * 16);
  const std::vector<Box> boxes{{{1, 3, 1}, {1, 5, 1}}, {{1, 3, 1}, {1.5F, 5, 1}}};  // in the first wall, and not
  const PatchSet beside{std::span<const Box>(boxes)};
  EXPECT_EQ(count_visibility(patches, beside, Occluders(), options).facing_away, wall);
  EXPECT_EQ(count_visibility(beside, patches, Occluders(), options).facing_away, wall);
}

TEST(VisibilityOfCorners, PatchesOfBothSidesInOnePlaneFaceAway) {
  expect_walls_face_away(9, 0);
  expect_walls_face_away(24, 0x1p-10F);  // groups of groups, which are not exact
}

TEST(VisibilityOfCorners, PatchesOfBothSidesInOnePlaneFaceAwayWhereTheyAreBoxes) {
  Walls walls;
  walls.add({0, 0, 0}, {0, 4, 0}, {0, 0, 4}, 4, 4);
  walls.add({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 4, 4);
  EXPECT_EQ(count_visibility(walls.patches(PatchSides::both), Occluders()).facing_away, std::uint64_t{16} * 15);
}

// Two walls that pass through each other: groups of the one reach to both sides of the other. Boxes float beside them,
// within the boxes around patches and elsewhere.
TEST(VisibilityOfCorners, GroupsOfBothSidesAreAnsweredAsTheirPatchesAre) {
  constexpr int size = 12;
  Walls leaning;
  leaning.add({0, 0, 0}, {size, 0, size}, {0, size, 0}, 9, 9);
  Walls across;
  across.add({size, 0, 0}, {-size, 0, size}, {0, size, 0}, 9, 8);
  std::vector<Box> floating;
  for (int i = 0; i != 6; ++i) {
    const auto y = static_cast<float>(2 * i);
    const float along = 1.3F * y;
    for (const float off : {-2.0F, -0.25F, 0.25F, 2.0F}) {
      const Vec3 lo{along + off, y, along - off};
      floating.push_back({lo, {lo[0] + 0.125F, lo[1] + 1, lo[2] + 0.125F}});
      floating.push_back({{size - lo[0], lo[1], lo[2]}, {size - lo[0] + 0.125F, lo[1] + 1, lo[2] + 0.125F}});
    }
  }
  Occluders occluders;
  occluders.add_boxes(floating);
  occluders.add_polygons(std::vector<Vec3>{{0, 0, 0}, {size, 0, size}, {size, size, size}, {0, size, 0}},
                         std::vector<std::size_t>{0, 4});
  const std::vector<Vec3> a_corners = leaning.rounded();
  const std::vector<Vec3> b_corners = across.rounded();
  const std::vector<std::size_t> one{0, 4};
  const PatchSet leaning_set = leaning.patches(PatchSides::both);
  const PatchSet across_set = across.patches(PatchSides::both);
  VisibilityOptions options;
  options.tolerance = 0x1p-12F;
  const SightCounts counts = count_visibility(leaning_set, across_set, occluders, options);
  EXPECT_EQ(count_visibility(across_set, leaning_set, occluders, options), counts);
  EXPECT_GT(counts.undecided, 1000U);
  EXPECT_GT(counts.clear, 1000U);
  if (has_shadow_memory) return;  // where thousands of calls take most of the time of all tests
  SightCounts expected;
  for (std::size_t i = 0; i != a_corners.size(); i += 4) {
    const PatchSet a(std::span<const Vec3>(a_corners).subspan(i, 4), one, PatchSides::both);
    for (std::size_t j = 0; j != b_corners.size(); j += 4) {
      const PatchSet b(std::span<const Vec3>(b_corners).subspan(j, 4), one, PatchSides::both);
      const SightCounts pair = count_visibility(a, b, occluders, options);
      expected.undecided += pair.undecided;
      expected.clear += pair.clear;
      expected.occluded += pair.occluded;
      expected.facing_away += pair.facing_away;
    }
  }
  EXPECT_EQ(counts, expected);
}

// Groups of groups of one leaning wall, seen from behind by boxes that face it.
TEST(VisibilityOfCorners, NothingFacesAwayFromAWallOfBothSides) {
  Walls walls;
  walls.add({0, 0, 0}, {40, 0, 40}, {0, 40, 0}, 40, 40);
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  for (int i = 0; i != 400; ++i) {
    const int row = i / 20;
    const Vec3 at{60 + static_cast<float>(i % 20), static_cast<float>(row), 1};
    boxes.push_back({at, at});
    planes.push_back({{-1, 0, 0}, -at[0]});
  }
  const PatchSet before{std::span<const Box>(boxes), std::span<const Plane>(planes)};
  const std::uint64_t pairs = walls.patches().size() * boxes.size();
  EXPECT_EQ(count_visibility(walls.patches(PatchSides::front), before, Occluders()).facing_away, pairs);
  EXPECT_EQ(count_visibility(walls.patches(PatchSides::both), before, Occluders()).clear, pairs);
  EXPECT_EQ(count_visibility(before, walls.patches(PatchSides::both), Occluders()).clear, pairs);
}

// A rectangle across an axis has the corners of the box around it; one that is turned has no interior.
TEST(VisibilityOfCorners, AHullWithTheCornersOfItsBoxIsThisSolidBoxThoughItIsFlat) {
  const std::vector<Box> ends{{{-2, -1, -1}, {-2, 1, 1}}, {{2, -1, -1}, {2, 1, 1}}};
  const PatchSet patches{std::span<const Box>(ends)};
  const std::vector<std::size_t> first{0, 4};
  Occluders across;
  across.add_solid_hulls(std::vector<Vec3>{{0, -3, -3}, {0, 3, -3}, {0, 3, 3}, {0, -3, 3}}, first);
  EXPECT_EQ(count_visibility(patches, across).occluded, 1U);
  Occluders aslant;
  aslant.add_solid_hulls(std::vector<Vec3>{{0, -3, -3}, {1, 3, -3}, {1, 3, 3}, {0, -3, 3}}, first);
  EXPECT_EQ(count_visibility(patches, aslant).undecided, 1U);
}

TEST(VisibilityOfCorners, ToleranceMovesEachCoordinate) {
  // The plane x + y + z = 3: moving each coordinate by t lowers the sum by 3 t.
  const std::vector<Vec3> corners{{3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  const std::vector<std::size_t> first{0, 3};
  const PatchSet patch{std::span<const Vec3>(corners), std::span<const std::size_t>(first)};
  const Box point{{1.5F, 1.5F, 1.5F}, {1.5F, 1.5F, 1.5F}};  // the sum is 4.5
  const PatchSet receiver(std::span<const Box>(&point, 1));
  VisibilityOptions options;
  options.tolerance = 0.5F;
  EXPECT_EQ(count_visibility(patch, receiver, Occluders(), options).facing_away, 1U);
  options.tolerance = std::nextafter(0.5F, 0.0F);
  EXPECT_EQ(count_visibility(patch, receiver, Occluders(), options).clear, 1U);
}

TEST(VisibilityOfCorners, APolygonHidesBoxesThatTouchItsPlaneByAnEdgeWhateverTheTolerance) {
  Occluders occluders;
  const std::vector<Vec3> wall{{0, -5, -5}, {0, 5, -5}, {0, 5, 5}, {0, -5, 5}};
  const std::vector<std::size_t> first{0, 4};
  occluders.add_polygons(wall, first);
  const Box left{{-1, 0, 0}, {0, 1, 0}};
  const Box right{{0, 0, 1}, {1, 1, 1}};
  const Box in_wall{{0, 0, 0}, {0, 1, 1}};
  const auto count = [&](const Box& a, const Box& b, float tolerance) {
    VisibilityOptions options;
    options.tolerance = tolerance;
    return count_visibility(PatchSet(std::span(&a, 1)), PatchSet(std::span(&b, 1)), occluders, options);
  };
  on_each_instruction_set([&] {
    for (const float tolerance : {0.0F, 0.25F}) {
      EXPECT_EQ(count(left, right, tolerance).occluded, 1U);
      EXPECT_EQ(count(left, in_wall, tolerance).occluded, 0U);
    }
  });
}

TEST(VisibilityOfCorners, NothingFacesAwayFromAPatchWithoutArea) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 5, 0}, {1, 5, 0}, {3, 5, 0}};
  const std::vector<std::size_t> first{0, 3, 6};
  const PatchSet patches{std::span<const Vec3>(corners), std::span<const std::size_t>(first)};
  on_each_instruction_set([&] { EXPECT_EQ(count_visibility(patches, Occluders()).clear, 1U); });
}

TEST(VisibilityOfCorners, AreRefusedUnlessTheyArePolygons) {
  std::vector<Vec3> corners(6, Vec3{0, 0, 0});
  const auto refused = [&](const std::vector<std::size_t>& first) {
    return message_of([&] { PatchSet(std::span<const Vec3>(corners), std::span<const std::size_t>(first)); });
  };
  EXPECT_EQ(refused({0, 4, 6}), "patch 1 has 2 corners; it takes 3 to 8");
  EXPECT_EQ(refused({0, 3}), "first_corner must begin with 0 and end with the number of corners, 6");
  EXPECT_EQ(refused({0, 4, 3, 6}), "first_corner[2] = 3 is less than the one before it");
  corners.resize(9);
  EXPECT_EQ(refused({0, 9}), "patch 0 has 9 corners; it takes 3 to 8");
  corners[4][1] = NAN;
  const auto bad = caught<BadBound>([&] {
    const std::vector<std::size_t> first{0, 3, 9};
    PatchSet(std::span<const Vec3>(corners), std::span<const std::size_t>(first));
  });
  ASSERT_TRUE(bad);
  EXPECT_EQ(bad->index(), 1U);
  EXPECT_EQ(bad->what(), std::string("patch 1 has a corner that is not finite"));
  EXPECT_EQ(PatchSet(std::span<const Vec3>(), std::span<const std::size_t>()).size(), 0U);
}

TEST(VisibilityOfCorners, AToleranceIsFiniteAndNotBelowZero) {
  for (const float tolerance : {-1.0F, INFINITY, NAN}) {
    VisibilityOptions options;
    options.tolerance = tolerance;
    EXPECT_THROW(static_cast<void>(count_visibility(PatchSet(), Occluders(), options)), InvalidArgument);
  }
}

}  // namespace
}  // namespace shaftcull
