// SPDX-License-Identifier: MIT
#include "solid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "patches.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::cli {
namespace {

/// Sines of angles below this are those of one plane.
constexpr double flat_angle = 1e-3;

double dot(const Point3& p, const Point3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

Point3 cross(const Point3& p, const Point3& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// Whether every edge belongs to two triangles. Vertices are the same if they are at the same place.
bool is_closed(std::span<const MeshTriangle> triangles) {
  std::map<std::pair<Vec3, Vec3>, unsigned> edges;
  for (const MeshTriangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = triangle.vertex[i];
      const Vec3& q = triangle.vertex[(i + 1) % 3];
      if (p != q) ++edges[std::minmax(p, q)];
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 2; });
}

/// The vertices where faces of three directions meet: those in an edge have two, those in a face one.
std::vector<Vec3> corners_of(std::span<const MeshTriangle> triangles) {
  std::map<Vec3, std::vector<Point3>> faces;
  for (const MeshTriangle& triangle : triangles) {
    const Point3 normal = normal_of(triangle);
    if (normal == Point3{}) continue;
    for (const Vec3& vertex : triangle.vertex) faces[vertex].push_back(normal);
  }
  std::vector<Vec3> corners;
  for (const auto& [vertex, normals] : faces) {
    Point3 edge{};
    double length = 0;
    for (const Point3& normal : normals) {
      const Point3 along = cross(normals.front(), normal);
      if (std::sqrt(dot(along, along)) > length) {
        edge = along;
        length = std::sqrt(dot(along, along));
      }
    }
    if (length < flat_angle) continue;
    const bool is_corner = std::any_of(normals.begin(), normals.end(), [&](const Point3& normal) {
      return std::abs(dot(edge, normal)) > flat_angle * length;
    });
    if (is_corner) corners.push_back(vertex);
  }
  return corners;
}

/// Whether all corners are on one side of the plane of each triangle.
bool is_convex(std::span<const MeshTriangle> triangles, std::span<const Vec3> corners, double slack) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const MeshTriangle& triangle) {
    const Point3 normal = normal_of(triangle);
    const double offset = dot(normal, in_doubles(triangle.vertex[0]));
    double before = 0;
    double behind = 0;
    for (const Vec3& corner : corners) {
      const double distance = dot(normal, in_doubles(corner)) - offset;
      before = std::max(before, distance);
      behind = std::max(behind, -distance);
    }
    return before <= slack || behind <= slack;
  });
}

}  // namespace

SolidShape solid_shape(std::span<const MeshTriangle> triangles) {
  SolidShape shape{{}, false, ""};
  if (!is_closed(triangles)) {
    shape.refusal = "it is not closed: an edge has one triangle, or more than two";
    return shape;
  }
  shape.corners = corners_of(triangles);
  if (shape.corners.size() < 4) {
    shape.refusal = "it is flat";
    return shape;
  }
  if (shape.corners.size() > most_solid_corners) {
    shape.refusal =
        fmt::format("it has {} corners, and a solid has {} at most", shape.corners.size(), most_solid_corners);
    return shape;
  }
  const Box box = box_around(shape.corners);
  double size = 0;
  double furthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size = std::max(size, double{box.hi[axis]} - double{box.lo[axis]});
    furthest = std::max({furthest, std::abs(double{box.lo[axis]}), std::abs(double{box.hi[axis]})});
  }
  if (!is_convex(triangles, shape.corners, 1e-4 * size + 1e-6 * furthest)) {
    shape.refusal = "it is not convex";
    return shape;
  }
  shape.is_box =
      shape.corners.size() == 8 && std::all_of(shape.corners.begin(), shape.corners.end(), [&](const Vec3& corner) {
        return (corner[0] == box.lo[0] || corner[0] == box.hi[0]) &&
               (corner[1] == box.lo[1] || corner[1] == box.hi[1]) && (corner[2] == box.lo[2] || corner[2] == box.hi[2]);
      });
  return shape;
}

}  // namespace shaftcull::cli
