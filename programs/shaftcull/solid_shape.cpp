// SPDX-License-Identifier: MIT
#include "solid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

Point3 middle_of(std::span<const Vec3> corners) {
  Point3 middle{};
  for (const Vec3& corner : corners) {
    for (std::size_t k = 0; k != 3; ++k) middle[k] += double{corner[k]} / static_cast<double>(corners.size());
  }
  return middle;
}

/// How far corners are on both sides of the plane of a triangle.
struct Dents {
  double deepest = 0;
  double share = 0;  ///< of the way from such a triangle to the middle, the largest
};

Dents dents_of(std::span<const MeshTriangle> triangles, std::span<const Vec3> corners) {
  const Point3 middle = middle_of(corners);
  Dents dents;
  for (const MeshTriangle& triangle : triangles) {
    const Point3 normal = normal_of(triangle);
    const double offset = dot(normal, in_doubles(triangle.vertex[0]));
    double before = 0;
    double behind = 0;
    for (const Vec3& corner : corners) {
      const double distance = dot(normal, in_doubles(corner)) - offset;
      before = std::max(before, distance);
      behind = std::max(behind, -distance);
    }
    const double depth = std::min(before, behind);
    dents.deepest = std::max(dents.deepest, depth);
    const double way = std::abs(dot(normal, middle) - offset);
    if (depth > 0) dents.share = std::max(dents.share, depth < way ? depth / way : 1);
  }
  return dents;
}

/// Corners of a dented body are moved to the middle until they are behind all triangles: patches of its surface then do
/// not lie in it.
void move_into_dents(const Dents& dents, std::vector<Vec3>& corners) {
  const Point3 middle = middle_of(corners);
  const double share = std::min(1.0, 2 * dents.share + 0x1p-22);
  for (Vec3& corner : corners) {
    for (std::size_t k = 0; k != 3; ++k) {
      corner[k] = static_cast<float>(corner[k] + share * (middle[k] - double{corner[k]}));
    }
  }
}

}  // namespace

SolidShape solid_shape(std::span<const MeshTriangle> triangles) {
  SolidShape shape;
  if (!is_closed(triangles)) {
    shape.refusal = "it is not closed: an edge has one triangle, or more than two";
    return shape;
  }
  shape.corners = corners_of(triangles);
  if (shape.corners.size() < 4) {
    shape.refusal = "it is flat";
    return shape;
  }
  const Box box = box_around(shape.corners);
  double size = 0;
  double furthest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size = std::max(size, double{box.hi[axis]} - double{box.lo[axis]});
    furthest = std::max({furthest, std::abs(double{box.lo[axis]}), std::abs(double{box.hi[axis]})});
  }
  const Dents dents = dents_of(triangles, shape.corners);
  if (dents.deepest > 1e-4 * size + 1e-6 * furthest) {
    shape.refusal = "it is not convex";
    return shape;
  }
  shape.is_box =
      shape.corners.size() == 8 && std::all_of(shape.corners.begin(), shape.corners.end(), [&](const Vec3& corner) {
        return (corner[0] == box.lo[0] || corner[0] == box.hi[0]) &&
               (corner[1] == box.lo[1] || corner[1] == box.hi[1]) && (corner[2] == box.lo[2] || corner[2] == box.hi[2]);
      });
  shape.is_dented = !shape.is_box && dents.deepest > 0;
  if (shape.is_dented) move_into_dents(dents, shape.corners);
  return shape;
}

}  // namespace shaftcull::cli
