// SPDX-License-Identifier: MIT
/// Convex hulls, and shafts between polygons, which are hulls that are blocked.
#include "shaftcull/hull.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "columns.hpp"
#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::hashes {
namespace {

/// One to eight points, in one plane or on one line now and then.
std::vector<Vec3> some_points(Numbers& numbers, Number number, std::size_t scene) {
  std::vector<Vec3> points;
  for (int left = 1 + numbers.below(8); left != 0; --left) points.push_back(point(numbers, number));
  if (numbers.below(6) == 0) {
    for (Vec3& p : points) p[scene % 3] = points[0][scene % 3];
  }
  return points;
}

/// Up to two directions, none as often as not.
std::vector<Vec3> some_directions(Numbers& numbers, Number number) {
  std::vector<Vec3> directions;
  for (int left = numbers.below(6) - 3; left > 0; --left) {
    const Vec3 direction = point(numbers, number);
    if (direction != Vec3{}) directions.push_back(direction);
  }
  return directions;
}

Vec3 any_of(Numbers& numbers, const std::vector<Vec3>& points) {
  return points[static_cast<std::size_t>(numbers.below(static_cast<int>(points.size())))];
}

/// Near one of the points, or on a line between two of them, or anywhere.
Vec3 near_hull(Numbers& numbers, Number number, bool touches, const std::vector<Vec3>& points) {
  if (!touches) return point(numbers, number);
  const Vec3 p = any_of(numbers, points);
  const Vec3 q = any_of(numbers, points);
  return edge_point(numbers, {p, p}, {q, q});
}

/// Boxes and spheres of which many touch a point of the hull, or a line or a plane through some of them.
void add_bounds(const CompiledShaft& hull, const std::vector<Vec3>& points, Numbers& numbers, std::size_t scene,
                Way way, Digest& digest) {
  const Number number = number_of(scene);
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i != bounds_a_scene; ++i) {
    const bool touches = !is_wild(scene) && numbers.below(2) == 0;
    const Vec3 p = any_of(numbers, points);
    const Vec3 on = touches ? edge_point(numbers, {p, p}, {any_of(numbers, points), p}) : point(numbers, number);
    boxes.push_back(numbers.below(4) == 0 ? Box{on, on} : sorted(on, point(numbers, number)));
    spheres.push_back({on, numbers.below(4) == 0 ? 0.0F : std::abs((numbers.*number)())});
  }
  add_answers(hull, BoxColumns(boxes).view(), way, digest);
  add_answers(hull, SphereColumns(spheres).view(), way, digest);
}

std::uint64_t bounds_of_hulls(std::uint64_t scenes, Way way, Contact contact) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    const std::vector<Vec3> points = some_points(numbers, number_of(s), s);
    const std::vector<Vec3> directions = some_directions(numbers, number_of(s));
    const ConvexHull hull(points, directions);
    CompiledShaft shaft = hull;
    set_contact(shaft, contact);
    add_bounds(shaft, points, numbers, s, way, digest);
  }
  return digest.value();
}

/// Triangles with vertices on edges of the hull, in its planes, and degenerate ones.
TriangleColumns triangles_near(Numbers& numbers, std::size_t scene, const std::vector<Vec3>& points) {
  std::vector<Triangle> triangles(bounds_a_scene);
  for (Triangle& triangle : triangles) {
    for (Vec3& vertex : triangle.vertex) {
      const bool touches = !is_wild(scene) && numbers.below(3) == 0;
      vertex = near_hull(numbers, number_of(scene), touches, points);
    }
    if (numbers.below(8) == 0) triangle.vertex[2] = triangle.vertex[numbers.below(2) == 0 ? 0 : 1];
  }
  triangles[scene % bounds_a_scene].vertex[scene % 2][scene % 3] = std::numeric_limits<float>::quiet_NaN();
  return TriangleColumns(triangles);
}

void add_triangles(const CompiledShaft& shaft, const TriangleView& triangles, Digest& digest) {
  std::vector<std::uint64_t> kept(bit_words(triangles.count));
  cull(shaft, triangles, kept, {.triangle_test = TriangleTest::exact});
  digest.add_all(kept);
}

/// One to six points: corners of a polygon across an axis, or anywhere.
std::vector<Vec3> some_polygon(Numbers& numbers, Number number) {
  std::vector<Vec3> corners;
  const auto axis = static_cast<std::size_t>(numbers.below(3));
  const bool is_flat = numbers.below(3) != 0;
  for (int left = 1 + numbers.below(6); left != 0; --left) {
    corners.push_back(point(numbers, number));
    if (is_flat) corners.back()[axis] = corners[0][axis];
  }
  return corners;
}

}  // namespace

std::uint64_t convex_hulls(std::uint64_t scenes, Way way) { return bounds_of_hulls(scenes, way, Contact::closed); }
std::uint64_t convex_hulls_open(std::uint64_t scenes, Way way) { return bounds_of_hulls(scenes, way, Contact::open); }

std::uint64_t triangles_of_hulls(std::uint64_t scenes, Way /*way*/) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    const std::vector<Vec3> points = some_points(numbers, number_of(s), s);
    const std::vector<Vec3> directions = some_directions(numbers, number_of(s));
    const ConvexHull hull(points, directions);
    const TriangleColumns triangles = triangles_near(numbers, s, points);
    CompiledShaft shaft = hull;
    for (const Contact contact : {Contact::closed, Contact::open}) {
      set_contact(shaft, contact);
      add_triangles(shaft, triangles.view(), digest);
    }
  }
  return digest.value();
}

/// Boxes between the two ends: which are kept, which block; and polygons that block.
std::uint64_t polygon_shafts(std::uint64_t scenes, Way way) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    const Number number = number_of(s);
    const std::vector<Vec3> p = some_polygon(numbers, number);
    const std::vector<Vec3> q = some_polygon(numbers, number);
    const ConvexHull shaft = between_polygons(p, q);
    std::vector<Vec3> corners = p;
    corners.insert(corners.end(), q.begin(), q.end());
    add_bounds(shaft, corners, numbers, s, way, digest);
    add_triangles(shaft, triangles_near(numbers, s, corners).view(), digest);
    const Box a = box_around(p);
    const Box b = box_around(q);
    std::vector<Box> solids;
    for (std::size_t i = 0; i != bounds_a_scene; ++i) {
      const Vec3 on = near_hull(numbers, number, numbers.below(2) == 0, corners);
      solids.push_back(numbers.below(2) == 0 ? around_middle(numbers, a, b) : sorted(on, point(numbers, number)));
    }
    std::vector<std::uint32_t> blocking;
    list_occluders(shaft, BoxColumns(solids).view(), blocking);
    for (const std::uint32_t index : blocking) digest.add(index);
    digest.add(blocking.size());
    std::vector<Vec3> screen;
    const Box& middle = solids[0];
    for (const float z : {middle.lo[2], middle.hi[2]}) screen.push_back({middle.lo[0], middle.lo[1], z});
    for (const float z : {middle.hi[2], middle.lo[2]}) screen.push_back({middle.hi[0], middle.hi[1], z});
    digest.add(occluded(shaft, screen) ? 1 : 0);
  }
  return digest.value();
}

}  // namespace shaftcull::hashes
