// SPDX-License-Identifier: MIT
/// Planes of convex hulls: found by triangles, against a search among all candidates, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compiled/hull_data.hpp"
#include "compiled/shaft_data.hpp"
#include "exact/small_hull.hpp"
#include "oracle/cases/hulls.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shafts/hull_formation.hpp"

namespace shaftcull {
namespace {

using kernel::HullData;

std::unique_ptr<HullData> vertices_of(const HullInput& input) {
  auto hull = std::make_unique<HullData>();
  const auto add = [&](const std::vector<Vec3>& vertices) {
    for (auto vertex = vertices.begin(); vertex != vertices.end(); ++vertex) {
      if (std::find(vertices.begin(), vertex, *vertex) != vertex) continue;
      std::copy_n(vertex->data(), 3, hull->vertex[hull->vertices++]);
    }
  };
  add(input.points);
  hull->points = hull->vertices;
  add(input.directions);
  return hull;
}

/// What differs between two hulls, in words; nothing if they are the same.
std::string difference(const HullData& a, const HullData& b) {
  if (!std::equal(a.box, a.box + 6, b.box)) return "box";
  if (a.farthest != b.farthest) return "farthest";
  if (a.is_bounded != b.is_bounded || a.suits_floats != b.suits_floats) return "flags";
  if (a.faces != b.faces || a.apart != b.apart) return "number of faces";
  if (a.edges != b.edges || a.face_edges != b.face_edges) return "number of edges";
  for (unsigned i = 0; i != a.faces + a.edges; ++i) {
    const HullData::Plane& p = a.plane[i];
    const HullData::Plane& q = b.plane[i];
    const std::size_t n = i < a.faces ? 3 : 2;
    const bool are_same = std::equal(p.inward, p.inward + n, q.inward) && p.offset == q.offset &&
                          p.length == q.length && p.magnitude == q.magnitude &&
                          std::equal(p.near, p.near + n, q.near) &&
                          std::equal(p.vertices, p.vertices + n, q.vertices) && p.axis == q.axis && p.sign == q.sign;
    if (!are_same) return "plane " + std::to_string(i);
  }
  if (a.culls_by_box != b.culls_by_box || a.culling_lanes != b.culling_lanes || a.lanes != b.lanes) return "lanes";
  constexpr unsigned planes = HullData::PlaneGroup::planes;
  for (unsigned i = 0; i != (a.lanes + planes - 1U) / planes * planes; ++i) {
    const HullData::PlaneGroup& p = a.group[i / planes];
    const HullData::PlaneGroup& q = b.group[i / planes];
    const unsigned lane = i % planes;
    bool are_same =
        p.offset[lane] == q.offset[lane] && p.length[lane] == q.length[lane] && p.magnitude[lane] == q.magnitude[lane];
    for (unsigned k = 0; k != 3; ++k) are_same &= p.inward[k][lane] == q.inward[k][lane];
    if (!are_same) return "lane " + std::to_string(i);
  }
  return "";
}

void expect_planes_of_search(const HullInput& input) {
  const auto formed = vertices_of(input);
  const auto searched = vertices_of(input);
  kernel::SmallHull triangles;
  kernel::form_hull(*formed, triangles);
  kernel::form_hull_by_search(*searched);
  ASSERT_EQ(difference(*formed, *searched), "") << source_text(input);
}

const HullData& data_of(const ConvexHull& hull) { return *kernel::data_of(hull.compiled()).hull; }

/// What differs between the edges and faces that triangles are compared with, of two hulls with the same vertices.
std::string difference_for_triangles(const HullData& a, const HullData& b) {
  if (a.creases != b.creases || a.facets != b.facets) return "numbers";
  for (unsigned c = 0; c != a.creases; ++c) {
    const HullData::Crease& p = a.crease[c];
    const HullData::Crease& q = b.crease[c];
    if (p.from != q.from || p.to != q.to || p.left != q.left || p.right != q.right) return "edge " + std::to_string(c);
  }
  for (unsigned f = 0; f != a.facets; ++f) {
    if (!std::equal(a.facet[f], a.facet[f] + 3, b.facet[f])) return "face " + std::to_string(f);
  }
  return "";
}

/// Casters of a view, which has points only, have the planes that a search finds for the points of both, and so have
/// casters of a copy, of which the view is gone. Returns whether the light is in the view.
bool expect_planes_of_casters(const HullInput& view, const Vec3& light, bool is_direction, HullTest test) {
  HullInput both = view;
  (is_direction ? both.directions : both.points).push_back(light);
  const auto searched = vertices_of(both);
  searched->is_conservative = test == HullTest::conservative;
  kernel::form_hull_by_search(*searched);
  auto original = std::make_unique<ConvexHull>(view.points, view.directions, test);
  const ConvexHull copy = *original;
  const auto casters_of = [&](const ConvexHull& of) {
    return is_direction ? casters_towards(of, light) : casters(of, light);
  };
  const ConvexHull found = casters_of(*original);
  const bool is_within = !is_direction && keeps(*original, Box{light, light});
  CompiledShaft open = *original;
  set_contact(open, Contact::open);
  if (is_within && view.directions.empty() && keeps(open, Box{light, light})) {
    EXPECT_EQ(difference_for_triangles(data_of(found), data_of(copy)), "") << source_text(both);
  }
  original.reset();
  EXPECT_EQ(difference(data_of(found), *searched), "") << source_text(both);
  EXPECT_EQ(difference(data_of(casters_of(copy)), *searched), "") << "of a copy: " << source_text(both);
  EXPECT_TRUE(std::ranges::equal(found.points(), both.points)) << source_text(both);
  EXPECT_TRUE(std::ranges::equal(found.directions(), both.directions)) << source_text(both);
  return is_within;
}

bool has_triangles(const HullInput& input) { return kernel::SmallHull(*vertices_of(input)).has_triangles(); }

HullInput corners_of_box(float size) {
  HullInput input;
  for (unsigned c = 0; c != 8; ++c) {
    input.points.push_back({(c & 1U) != 0 ? size : 0, (c & 2U) != 0 ? size : 0, (c & 4U) != 0 ? size : 0});
  }
  return input;
}

Vec3 point_of_sphere(Random& random) {
  const Vec3 x = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  const float length = std::hypot(x[0], x[1], x[2]) + 1e-6F;
  return {x[0] / length, x[1] / length, x[2] / length};
}

TEST(HullFormation, FindsThePlanesOfPointsOnASphere) {
  Random random(1);
  for (std::uint64_t i = 0; i != random_cases(40); ++i) {
    HullInput input;
    const unsigned count = 4 + random.below(29);
    for (unsigned p = 0; p != count; ++p) input.points.push_back(point_of_sphere(random));
    expect_planes_of_search(input);
    if (HasFatalFailure()) return;
  }
}

TEST(HullFormation, FindsThePlanesOfPointsAnywhere) {
  Random random(2);
  for (std::uint64_t i = 0; i != random_cases(1000); ++i) {
    expect_planes_of_search(hull_of(random, 12, [&] { return random.uniform(-10, 10); }));
    if (HasFatalFailure()) return;
  }
}

TEST(HullFormation, FindsThePlanesOfPointsOnAGrid) {
  Random random(3);
  for (std::uint64_t i = 0; i != random_cases(2000); ++i) {
    const int side = 1 + static_cast<int>(random.below(3));
    const float step = random.one_in(2) ? 1 : 0.1F;
    const float at = random.one_in(3) ? 1e5F : 0;
    expect_planes_of_search(hull_of(random, 14, [&] { return random.integer(-side, side) * step + at; }));
    if (HasFatalFailure()) return;
  }
}

TEST(HullFormation, FindsThePlanesOfPointsOfAllMagnitudes) {
  Random random(4);
  for (std::uint64_t i = 0; i != random_cases(1000); ++i) {
    const int high = static_cast<int>(random.integer(-140, 127));
    const int low = random.one_in(2) ? -149 : std::max(-149, high - 30);
    expect_planes_of_search(hull_of(random, 9, [&] { return random.wild(low, high); }));
    if (HasFatalFailure()) return;
  }
}

TEST(HullFormation, FindsThePlanesOfDirections) {
  Random random(5);
  for (std::uint64_t i = 0; i != random_cases(1000); ++i) {
    const bool is_on_grid = random.one_in(2);
    const auto coordinate = [&]() -> float { return is_on_grid ? random.integer(-2, 2) : random.uniform(-1, 1); };
    HullInput input = hull_of(random, 6, coordinate);
    const unsigned count = 1 + random.below(6);
    // On one side of a plane as often as not.
    const float lift = random.one_in(2) ? 3 : 0;
    while (input.directions.size() < count) {
      const Vec3 direction = {coordinate(), coordinate(), coordinate() + lift};
      if (direction != Vec3{0, 0, 0}) input.directions.push_back(direction);
    }
    expect_planes_of_search(input);
    if (HasFatalFailure()) return;
  }
}

TEST(HullFormation, FindsFacesWithManyVerticesOnce) {
  HullInput box = corners_of_box(3);
  for (const float x : {1.0F, 2.0F}) {  // on edges, in faces and inside
    for (const Vec3& between : {Vec3{x, 0, 0}, Vec3{3, 3, x}, Vec3{x, x, 3}, Vec3{0, x, 1}, Vec3{x, 1, 1}}) {
      box.points.push_back(between);
    }
  }
  expect_planes_of_search(box);
  std::reverse(box.points.begin(), box.points.end());
  expect_planes_of_search(box);
  for (Vec3& p : box.points) p = {p[0] + 2 * p[1], p[1] - p[2] + p[0], p[2] + 3 * p[0]};  // no face along an axis
  expect_planes_of_search(box);
}

TEST(HullFormation, ExtendsViewsByALightToThePlanesOfASearch) {
  Random random(7);
  std::size_t within = 0;
  std::size_t beyond = 0;
  for (std::uint64_t i = 0; i != random_cases(2000) && !HasFailure(); ++i) {
    // Lights on a grid are often in the plane of a face, on the line of an edge, or a corner.
    const bool is_on_grid = random.one_in(2);
    const float size = std::ldexp(1.0F, random.one_in(3) ? static_cast<int>(random.integer(-120, 100)) : 0);
    const auto coordinate = [&] { return size * (is_on_grid ? random.integer(-2, 2) : random.uniform(-2, 2)); };
    HullInput view = hull_of(random, 9, coordinate);
    if (!random.one_in(8)) view.directions.clear();
    if (view.points.size() + view.directions.size() == ConvexHull::max_vertices) continue;
    const float far = random.one_in(4) ? 1000 : random.one_in(2) ? 2 : 0.5F;
    Vec3 light = {far * coordinate(), far * coordinate(), far * coordinate()};
    if (random.one_in(8)) light = view.points[random.below(static_cast<unsigned>(view.points.size()))];
    const bool is_direction = random.one_in(3) && light != Vec3{0, 0, 0};
    const HullTest test = random.one_in(2) ? HullTest::exact : HullTest::conservative;
    ++(expect_planes_of_casters(view, light, is_direction, test) ? within : beyond);
  }
  EXPECT_GT(within, 0U) << "the cases are too easy";
  EXPECT_GT(beyond, 0U) << "the cases are too easy";
}

TEST(HullFormation, ExtendsViewsByALightFarAwayInThePlanesOfFaces) {
  Random random(9);
  for (std::uint64_t i = 0; i != random_cases(2000) && !HasFailure(); ++i) {
    HullInput view = hull_of(random, 6, [&] { return random.integer(-65535, 65535); });
    view.directions.clear();
    if (view.points.size() < 4) continue;
    // On the line through two corners, without rounding. Doubles do not tell that it is in the planes there.
    const auto count = static_cast<unsigned>(view.points.size());
    const Vec3 p = view.points[random.below(count)];
    const Vec3 q = view.points[random.below(count)];
    Vec3 light{};
    for (std::size_t k = 0; k != 3; ++k) light[k] = p[k] + 100 * (q[k] - p[k]);
    expect_planes_of_casters(view, light, false, HullTest::exact);
  }
}

TEST(HullFormation, ExtendsExtendedViews) {
  Random random(8);
  for (std::uint64_t i = 0; i != random_cases(300) && !HasFailure(); ++i) {
    const auto coordinate = [&] { return random.uniform(-2, 2); };
    HullInput all = hull_of(random, 8, coordinate);
    all.directions.clear();
    ConvexHull hull(all.points);
    for (int lights = 0; lights != 6; ++lights) {
      const Vec3 light{3 * coordinate(), 3 * coordinate(), 3 * coordinate()};
      hull = casters(hull, light);
      all.points.push_back(light);
      const auto searched = vertices_of(all);
      kernel::form_hull_by_search(*searched);
      EXPECT_EQ(difference(data_of(hull), *searched), "") << source_text(all);
    }
  }
}

TEST(HullFormation, NeedsNoSearchForHullsWithAnInterior) {
  Random random(6);
  for (std::uint64_t i = 0; i != random_cases(100); ++i) {
    HullInput input = hull_of(random, 20, [&] { return random.uniform(-1, 1); });
    input.directions.clear();
    EXPECT_EQ(has_triangles(input), input.points.size() >= 4) << source_text(input);
  }
  HullInput view = corners_of_box(1);  // a direction beside two others, and more than a right angle from them
  view.directions = {{1, 0.1F, 0}, {1, -0.1F, 0}, {-0.9F, 0, 0.5F}};
  EXPECT_TRUE(has_triangles(view));
}

TEST(HullFormation, SearchesWhereThereAreNoTriangles) {
  HullInput flat = corners_of_box(1);
  for (Vec3& p : flat.points) p[2] = p[0] + p[1];
  EXPECT_FALSE(has_triangles(flat));
  expect_planes_of_search(flat);
  HullInput column = corners_of_box(1);
  column.directions = {{1, 2, 3}, {-1, -2, -3}};
  EXPECT_FALSE(has_triangles(column));
  expect_planes_of_search(column);
}

TEST(HullFormation, TrianglesKnowAllVerticesInTheirPlanes) {
  HullInput box = corners_of_box(2);
  box.points.push_back({1, 1, 2});
  box.points.push_back({1, 1, 1});
  const auto hull = vertices_of(box);
  const kernel::SmallHull mesh(*hull);
  ASSERT_GE(mesh.count(), 12U);
  for (unsigned t = 0; t != mesh.count(); ++t) {
    EXPECT_EQ(std::popcount(mesh[t].in_plane), (mesh[t].in_plane >> 8U & 1U) != 0 ? 5 : 4);
    for (unsigned e = 0; e != 3; ++e) {
      EXPECT_EQ(mesh.left_of(mesh[t].corner(e), mesh[t].corner((e + 1) % 3)), t);
    }
  }
}

}  // namespace
}  // namespace shaftcull
