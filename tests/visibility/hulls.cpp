// SPDX-License-Identifier: MIT
/// Solid hulls: their faces, what they hide from single ends against the oracle, and in scenes of many patches.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "exact/hull_cone.hpp"
#include "exact/hull_mesh.hpp"
#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "oracle/sight.hpp"
#include "sanitizers.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull {
namespace {

using kernel::EndPoints;
using kernel::HullCone;
using kernel::HullMesh;

std::vector<Vec3> corners_of(const Box& box) {
  std::vector<Vec3> corners;
  for (unsigned c = 0; c != 8; ++c) {
    Vec3 corner{};
    for (unsigned k = 0; k != 3; ++k) corner[k] = (c >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
    corners.push_back(corner);
  }
  return corners;
}

TEST(HullMesh, OfACubeWithPointsInItsFacesAndEdgesHasSixFacesAndTwelveEdges) {
  std::vector<Vec3> points;
  constexpr std::array<float, 3> steps{0, 1, 2};
  for (const float x : steps) {
    for (const float y : steps) {
      for (const float z : steps) points.push_back({x, y, z});
    }
  }
  std::uint64_t state = 1;
  for (int round = 0; round != 50; ++round) {
    for (std::size_t i = points.size(); i > 1; --i) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      std::swap(points[i - 1], points[(state >> 33U) % i]);
    }
    const HullMesh mesh(points);
    EXPECT_EQ(mesh.faces().size(), 6U);
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> length;  // of the edges between two faces
    for (const HullMesh::Edge& edge : mesh.edges()) {
      double square = 0;
      for (std::size_t k = 0; k != 3; ++k) square += (edge.to[k] - edge.from[k]) * (edge.to[k] - edge.from[k]);
      length[std::minmax({edge.left, edge.right})] += std::sqrt(square);
    }
    EXPECT_EQ(length.size(), 12U);
    for (const auto& of_edge : length) EXPECT_EQ(of_edge.second, 2);
  }
}

TEST(HullMesh, OfPointsInOnePlaneHasNoInterior) {
  EXPECT_FALSE(HullMesh(std::vector<Vec3>(5, Vec3{1, 2, 3})).has_interior());
  EXPECT_FALSE(HullMesh(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).has_interior());
  EXPECT_FALSE(HullMesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}, {2, 5, 2}}).has_interior());
  EXPECT_TRUE(HullMesh(std::vector<Vec3>{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0x1p-149F}}).has_interior());
}

TEST(HullMesh, HasAllPointsBehindItsFacesAndEachEdgeInTwoOfThem) {
  Random random(7);
  for (std::uint64_t left = random_cases(3000); left != 0; --left) {
    std::vector<Vec3> points(4 + random.below(30));
    const bool is_lattice = random.one_in(2);
    for (Vec3& point : points) {
      for (float& x : point) x = is_lattice ? random.integer(0, 4) : random.uniform(-1, 1);
    }
    const HullMesh mesh(points);
    for (const kernel::NearPlane& face : mesh.faces()) {
      for (const Vec3& point : points) ASSERT_LE(face.side(point), 0);
    }
    for (const HullMesh::Edge& edge : mesh.edges()) {
      for (const std::uint32_t f : {edge.left, edge.right}) {
        const kernel::NearPlane& face = mesh.faces()[f];
        ASSERT_EQ(face.side(edge.from), 0);
        ASSERT_EQ(face.side(edge.to), 0);
      }
    }
  }
}

/// A hull between two ends that are polygons of three corners or more, or points.
struct HullCase {
  std::vector<Vec3> hull;
  std::vector<Vec3> a;
  std::vector<Vec3> b;
  float tolerance = 0;

  explicit HullCase(std::uint64_t seed) {
    Random random(seed);
    const bool is_lattice = !random.one_in(3);
    const auto coordinate = [&](float lo, float hi) {
      return is_lattice ? random.integer(static_cast<int>(lo), static_cast<int>(hi)) : random.uniform(lo, hi);
    };
    const auto draw = [&](std::size_t count, float from, float to, float side) {
      std::vector<Vec3> points(count);
      for (Vec3& point : points) point = {coordinate(from, to), coordinate(-side, side), coordinate(-side, side)};
      return points;
    };
    if (random.one_in(3)) {
      hull = corners_of({{-1, -3, -2}, {1, 3, 4}});
      if (random.one_in(2)) hull[7] = {1, 2, 5};
    } else {
      hull = draw(4 + random.below(8), -2, 2, 4);
    }
    const float near = random.one_in(3) ? 1.0F : 2.0F;
    const float wide = random.one_in(2) ? 1.0F : 3.0F;
    a = draw(1 + random.below(4), -4, -near, wide);
    b = draw(1 + random.below(4), near, 4, wide);
    if (random.one_in(4)) a.push_back(hull[random.below(static_cast<unsigned>(hull.size()))]);
    if (random.one_in(6)) b.push_back(a[0]);
    if (random.one_in(4)) tolerance = is_lattice ? 0.5F : random.uniform(0, 0.3F);
  }

  [[nodiscard]] oracle::SightQuestion question() const {
    oracle::SightQuestion question;
    question.a = {box_around(a)};
    question.b = {box_around(b)};
    question.a_corners = {a};
    question.b_corners = {b};
    question.hulls = {hull};
    question.tolerance = tolerance;
    return question;
  }
};

void form(HullCone& cone, const HullMesh& mesh, const std::vector<Vec3>& end, EndPoints counting, float tolerance) {
  cone.begin(mesh, end, counting, tolerance);
  cone.add_edges();
}

TEST(HullCone, HidesWhatTheOracleSays) {
  std::uint64_t hidden = 0;
  std::uint64_t by_all = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(20000); ++seed) {
    const HullCase of(seed);
    const HullMesh mesh(of.hull);
    if (!mesh.has_interior()) continue;
    HullCone cone;
    form(cone, mesh, of.a, EndPoints::of_relative_interior, of.tolerance);
    const bool hides = cone.hides(of.b);
    ASSERT_EQ(hides, oracle::SightOracle(of.question()).truth(0, 0).is_occluded) << "HullCase(" << seed << ")";
    HullCone back;
    form(back, mesh, of.b, EndPoints::of_relative_interior, of.tolerance);
    ASSERT_EQ(hides, back.hides(of.a)) << "the other way about, HullCase(" << seed << ")";
    form(cone, mesh, of.a, EndPoints::all, of.tolerance);
    const bool hides_all = cone.hides(of.b);
    if (of.hull == corners_of(box_around(of.hull))) {
      const Box box = box_around(of.hull);
      const float faces[6] = {box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]};
      HullMesh of_box;
      of_box.become(faces);
      form(cone, of_box, of.a, EndPoints::of_relative_interior, of.tolerance);
      ASSERT_EQ(hides, cone.hides(of.b)) << "as a box, HullCase(" << seed << ")";
    }
    ASSERT_TRUE(hides || !hides_all) << "all points, HullCase(" << seed << ")";
    hidden += hides ? 1 : 0;
    by_all += hides_all ? 1 : 0;
  }
  EXPECT_GT(hidden, random_cases(1000));
  EXPECT_GT(hidden - by_all, random_cases(100));  // some touch
}

/// Squares in a plane across the x axis, which face along it, turned about the z axis.
std::vector<Vec3> wall(float x, bool faces_up, double angle) {
  std::vector<Vec3> corners;
  for (int y = -4; y != 4; ++y) {
    for (int z = 0; z != 4; ++z) {
      const std::array<unsigned, 4> order = faces_up ? std::array{0U, 1U, 3U, 2U} : std::array{0U, 2U, 3U, 1U};
      for (const unsigned c : order) {
        const double along = y + static_cast<double>(c & 1U);
        const double height = z + static_cast<double>(c >> 1U);
        corners.push_back({static_cast<float>(x * std::cos(angle) - along * std::sin(angle)),
                           static_cast<float>(x * std::sin(angle) + along * std::cos(angle)),
                           static_cast<float>(height)});
      }
    }
  }
  return corners;
}

PatchSet set_of(const std::vector<Vec3>& corners) {
  std::vector<std::size_t> first{0};
  while (first.back() != corners.size()) first.push_back(first.back() + 4);
  return PatchSet(std::span<const Vec3>(corners), std::span<const std::size_t>(first));
}

/// A prism around the z axis, n corners above and below.
std::vector<Vec3> prism(unsigned n, double radius, double angle) {
  constexpr double turn = 6.283185307179586;
  std::vector<Vec3> corners;
  for (unsigned i = 0; i != n; ++i) {
    const double at = angle + turn * (i + 0.5) / n;
    const auto x = static_cast<float>(radius * std::cos(at));
    const auto y = static_cast<float>(radius * std::sin(at));
    corners.push_back({x, y, -1});
    corners.push_back({x, y, 5});
  }
  return corners;
}

TEST(SolidHulls, HideAsMuchTurnedAsUpright) {
  std::array<SightCounts, 2> counts;
  for (const double angle : {0.0, 0.5}) {
    const PatchSet a = set_of(wall(-3, true, angle));
    const PatchSet b = set_of(wall(3, false, angle));
    const std::vector<Vec3> block = prism(4, 2 * std::sqrt(2.0), angle);
    Occluders occluders;
    occluders.add_solid_hulls(block, std::vector<std::size_t>{0, block.size()});
    on_each_instruction_set([&] { counts[angle == 0 ? 0 : 1] = count_visibility(a, b, occluders); });
    EXPECT_GT(counts[angle == 0 ? 0 : 1].occluded, 300U);
  }
  EXPECT_NEAR(static_cast<double>(counts[0].occluded), static_cast<double>(counts[1].occluded), 12);
}

TEST(SolidHulls, OfManyCornersHideWhatIsBehind) {
  const PatchSet a = set_of(wall(-3, true, 0));
  const PatchSet b = set_of(wall(3, false, 0));
  const std::vector<Vec3> column = prism(48, 2.5, 0);
  Occluders occluders;
  EXPECT_EQ(occluders.add_solid_hulls(column, std::vector<std::size_t>{0, column.size()}), 0U);
  FoundSolids found;
  found.hull_corners = column;
  found.first_hull_corner = {0, column.size()};
  Occluders of_found;
  of_found.add_found(found);
  on_each_instruction_set([&] {
    const SightCounts counts = count_visibility(a, b, occluders);
    EXPECT_GT(counts.occluded, 300U);
    EXPECT_GT(counts.undecided, 0U);
    const SightCounts by_found = count_visibility(a, b, of_found);
    EXPECT_EQ(by_found.occluded, counts.occluded);
    EXPECT_EQ(by_found.clear, counts.clear + counts.undecided);
  });
}

TEST(SolidHulls, HideNoPatchOfTheirOwnSurfaceFromWhatItSees) {
  // The face of the block at −2 is a little in front of the patches, which are rounded.
  const double angle = 0.5;
  const PatchSet patches = set_of(wall(-2 + 0x1p-20F, false, angle));
  const PatchSet in_front = set_of(wall(-3, true, angle));
  const std::vector<Vec3> block = prism(4, 2 * std::sqrt(2.0), angle);
  std::vector<Vec3> wide;  // so that all patches lie in the block
  for (const Vec3& corner : block) {
    const double along = corner[1] * std::cos(angle) - corner[0] * std::sin(angle);
    wide.push_back({static_cast<float>(corner[0] - 2 * along * std::sin(angle)),
                    static_cast<float>(corner[1] + 2 * along * std::cos(angle)), corner[2]});
  }
  FoundSolids found;
  found.hull_corners = wide;
  found.first_hull_corner = {0, wide.size()};
  Occluders occluders;
  occluders.add_found(found);
  VisibilityOptions with_tolerance;
  with_tolerance.tolerance = 0x1p-18F;
  VisibilityOptions with_rays;
  with_rays.solids_around_ends = false;
  on_each_instruction_set([&] {
    const std::uint64_t pairs = patches.size() * in_front.size();
    EXPECT_EQ(count_visibility(patches, in_front, occluders, with_tolerance).clear, pairs);
    EXPECT_EQ(count_visibility(patches, in_front, occluders, with_rays).clear, pairs);
    EXPECT_EQ(count_visibility(patches, in_front, occluders).occluded, pairs);
  });
}

TEST(VisibilityHulls, GroupsWithAPointInTheSurfaceAreNotHiddenAsAWhole) {
  // One point of each set is in a face, x + y + z = 4: the segment between these two lies in the surface.
  // All other points are in the interior.
  const std::vector<Vec3> octahedron{{-4, 0, 0}, {4, 0, 0}, {0, -4, 0}, {0, 4, 0}, {0, 0, -4}, {0, 0, 4}};
  const std::vector<std::size_t> whole{0, octahedron.size()};
  Occluders occluders;
  occluders.add_solid_hulls(octahedron, whole);
  constexpr unsigned points = 300;
  const auto below = [](const Vec3& corner) {
    std::vector<Box> boxes;
    for (unsigned i = 0; i != points; ++i) {
      const float depth = static_cast<float>(i) * 0x1p-11F;
      const Vec3 p{corner[0] - depth, corner[1] - depth, corner[2] - depth};
      boxes.push_back({p, p});
    }
    return boxes;
  };
  const PatchSet a(below({2, 1, 1}));
  const PatchSet b(below({1, 1, 2}));
  on_each_instruction_set(
      [&] { EXPECT_EQ(count_visibility(a, b, occluders).occluded, std::uint64_t{points} * points - 1); });
}

TEST(VisibilityHulls, BoxesInsideBodiesHideNothingWhereAnswersAgreeWithRays) {
  // Each body reaches around both patches, and a box inside it lies between them.
  const PatchSet left(std::vector<Box>{{{-3, -0.0625F, -0.0625F}, {-2.5F, 0.0625F, 0.0625F}}});
  const PatchSet right(std::vector<Box>{{{2.5F, -0.0625F, -0.0625F}, {3, 0.0625F, 0.0625F}}});
  const std::vector<Vec3> octahedron{{-4, 0, 0}, {4, 0, 0}, {0, -4, 0}, {0, 4, 0}, {0, 0, -4}, {0, 0, 4}};
  const std::vector<std::size_t> whole{0, octahedron.size()};
  Occluders given;
  given.add_solid_hulls(octahedron, whole);
  FoundSolids hull;
  hull.hull_corners = octahedron;
  hull.first_hull_corner = whole;
  Occluders found_hull;
  found_hull.add_found(hull);
  FoundSolids boxes;
  boxes.inner_boxes = {{{-1, -1, -1}, {1, 1, 1}}};
  Occluders found_box;
  found_box.add_found(boxes);
  // As much of it as a solid box that is there hides.
  Occluders joined = found_box;
  joined.add_solids(std::vector<Box>{{{-1, 1, -1}, {1, 2, 1}}});
  VisibilityOptions with_rays;
  with_rays.solids_around_ends = false;
  on_each_instruction_set([&] {
    for (const Occluders* occluders : {&given, &found_hull, &found_box, &joined}) {
      EXPECT_EQ(count_visibility(left, right, *occluders).occluded, 1U);
      EXPECT_EQ(count_visibility(left, right, *occluders, with_rays).occluded, 0U);
      EXPECT_EQ(count_visibility(left, right, *occluders).occluded, 1U);
    }
    joined.add_solids(std::vector<Box>{{{-1, -1, -1}, {1, 1, 1}}});
    EXPECT_EQ(count_visibility(left, right, joined, with_rays).occluded, 1U);
    joined = found_box;
    joined.add_solids(std::vector<Box>{{{-1, 1, -1}, {1, 2, 1}}});
  });
}

}  // namespace
}  // namespace shaftcull
