// SPDX-License-Identifier: MIT
// Two furnished rooms, and the rays and form factors of their patches. For baking.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <shaftcull/shaftcull.hpp>
#include <span>
#include <vector>

namespace sc = shaftcull;
using Point = std::array<double, 3>;

inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Point point(const sc::Vec3& v) { return {v[0], v[1], v[2]}; }
// u of the way from vertex 0 to vertex 1 and v of that to vertex 2.
inline Point mix(const sc::Triangle& t, double u, double v) {
  const Point a = point(t.vertex[0]);
  const Point to_b = point(t.vertex[1]) - a;
  const Point to_c = point(t.vertex[2]) - a;
  return {a[0] + u * to_b[0] + v * to_c[0], a[1] + u * to_b[1] + v * to_c[1],
          a[2] + u * to_b[2] + v * to_c[2]};
}
inline Point normal_of(const sc::Triangle& t) {
  return cross(mix(t, 1, 0) - mix(t, 0, 0), mix(t, 0, 1) - mix(t, 0, 0));
}

// [[mesh]]
inline bool holds(const sc::Box& box, const sc::Vec3& p) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (p[k] < box.lo[k] || p[k] > box.hi[k]) return false;
  }
  return true;
}

// The sides of a box in triangles with legs of `size` or less. Those of a room face inwards;
// what lies in an opening is left out.
inline void add_box(std::vector<sc::Triangle>& mesh, const sc::Box& box, float size,
                    bool inwards, std::span<const sc::Box> openings = {}) {
  for (std::size_t side = 0; side != 6; ++side) {
    const std::size_t k = side % 3;
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const auto cells = [&](std::size_t axis) {
      return static_cast<int>(std::ceil((box.hi[axis] - box.lo[axis]) / size));
    };
    const auto at = [&](std::size_t axis, int cell) {
      return std::min(box.hi[axis], box.lo[axis] + static_cast<float>(cell) * size);
    };
    for (int p = 0; p != cells(i); ++p) {
      for (int q = 0; q != cells(j); ++q) {
        sc::Vec3 corner[4];
        for (int c = 0; c != 4; ++c) {
          corner[c][k] = side < 3 ? box.lo[k] : box.hi[k];
          corner[c][i] = at(i, p + (c == 1 || c == 2 ? 1 : 0));
          corner[c][j] = at(j, q + (c >= 2 ? 1 : 0));
        }
        if (std::any_of(openings.begin(), openings.end(), [&](const sc::Box& opening) {
              return holds(opening, corner[0]) && holds(opening, corner[2]);
            }))
          continue;
        if ((side < 3) != inwards) std::swap(corner[1], corner[3]);
        mesh.push_back({{{corner[0], corner[1], corner[2]}}});
        mesh.push_back({{{corner[0], corner[2], corner[3]}}});
      }
    }
  }
}
// [[end]]

// [[formfactor]]
// The share of the light from a point of a patch that reaches another patch, if nothing is
// between: Lambert's sum over the edges of the part in front of the patch.
inline double form_factor(const Point& from, const Point& normal, const sc::Triangle& to) {
  std::vector<Point> seen;
  for (std::size_t c = 0; c != 3; ++c) {
    const Point a = point(to.vertex[c]) - from;
    const Point b = point(to.vertex[(c + 1) % 3]) - from;
    const double before = dot(a, normal);
    const double behind = dot(b, normal);
    if (before >= 0) seen.push_back(a);
    if ((before < 0) != (behind < 0)) {
      const double t = before / (before - behind);
      seen.push_back(
          {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
    }
  }
  double sum = 0;
  for (std::size_t c = 0; c != seen.size(); ++c) {
    const Point& a = seen[c];
    const Point& b = seen[(c + 1) % seen.size()];
    const Point across = cross(a, b);
    const double sine = std::sqrt(dot(across, across));
    if (sine > 0) sum += std::atan2(sine, dot(a, b)) * dot(across, normal) / sine;
  }
  return std::fabs(sum) / (2 * std::numbers::pi);
}
// [[end]]

struct Scene {
  std::vector<sc::Triangle> mesh;  // what exchanges light
  std::vector<sc::Box> boxes;      // around each triangle
  std::vector<sc::Plane> planes;   // of each triangle
  sc::PatchSet patches;
  sc::Occluders occluders;
  std::vector<std::vector<sc::Triangle>> shape;  // what rays meet of each occluder
};

// [[scene]]
// Two rooms of 4 by 5 by 3 metres, a wall of 25 cm with a door between them.
const std::array<sc::Box, 2> rooms{sc::Box{{0, 0, 0}, {4, 5, 3}},
                                   sc::Box{{4.25F, 0, 0}, {8.25F, 5, 3}}};
const sc::Box passage{{4, 2, 0}, {4.25F, 3, 2}};
const std::array<sc::Box, 2> door{sc::Box{{4, 2, 0}, {4, 3, 2}},
                                  sc::Box{{4.25F, 2, 0}, {4.25F, 3, 2}}};
const std::array<sc::Box, 3> wall{sc::Box{{4, 0, 0}, {4.25F, 2, 3}},
                                  sc::Box{{4, 3, 0}, {4.25F, 5, 3}},
                                  sc::Box{{4, 2, 2}, {4.25F, 3, 3}}};
// Furniture, on feet that are too thin to count.
const sc::Box sideboard{{1, 0.5F, 0.25F}, {2.5F, 1, 1.25F}};
const sc::Box cupboard{{5.75F, 0.75F, 0.25F}, {6.75F, 1.25F, 2.25F}};  // turned by 30 degrees
const std::array<sc::Box, 3> shelf{sc::Box{{1, 3.5F, 0.5F}, {3, 4, 0.5625F}},
                                   sc::Box{{1, 3.5F, 1}, {3, 4, 1.0625F}},
                                   sc::Box{{1, 3.5F, 1.5F}, {3, 4, 1.5625F}}};

inline void turn(sc::Vec3& p) {  // with the cupboard, around its middle
  const float x = p[0] - 6.25F;
  const float y = p[1] - 1;
  p = {6.25F + 0.866F * x - 0.5F * y, 1 + 0.5F * x + 0.866F * y, p[2]};
}

// The triangles of a thing, out of boxes, turned or not.
inline std::vector<sc::Triangle> triangles_of(std::span<const sc::Box> boxes, float size,
                                              bool turned = false) {
  std::vector<sc::Triangle> triangles;
  for (const sc::Box& box : boxes) add_box(triangles, box, size, false);
  for (sc::Triangle& t : triangles) {
    for (sc::Vec3& p : t.vertex) {
      if (turned) turn(p);
    }
  }
  return triangles;
}

inline void add_mesh(Scene& scene, float size) {
  for (const sc::Box& room : rooms) add_box(scene.mesh, room, size, true, door);
  add_box(scene.mesh, passage, size, true, door);
  for (const auto& thing :
       {triangles_of(std::span(&sideboard, 1), size),
        triangles_of(std::span(&cupboard, 1), size, true), triangles_of(shelf, size)})
    scene.mesh.insert(scene.mesh.end(), thing.begin(), thing.end());
}
// [[end]]

// [[patches]]
inline void add_patches(Scene& scene) {
  for (const sc::Triangle& t : scene.mesh) {
    const Point n = normal_of(t);
    scene.boxes.push_back(sc::box_around(t.vertex));
    scene.planes.push_back(
        {{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])},
         static_cast<float>(dot(n, point(t.vertex[0])))});
  }
  scene.patches = sc::PatchSet(scene.boxes, scene.planes);
}
// [[end]]

// [[occluders]]
// Each thing is one occluder, or some; `shape` has what rays meet of each of them. Whatever is
// known to be solid is added as such, and not as triangles, too.
inline void add_occluders(Scene& scene) {
  constexpr float whole = 10;  // faces need not be cut for rays
  scene.occluders.add_solids(wall);
  for (const sc::Box& box : wall)
    scene.shape.push_back(triangles_of(std::span(&box, 1), whole));

  scene.occluders.add_solids(std::span(&sideboard, 1));
  scene.shape.push_back(triangles_of(std::span(&sideboard, 1), whole));

  // The corners of the twelve triangles are the eight corners of the cupboard.
  scene.shape.push_back(triangles_of(std::span(&cupboard, 1), whole, true));
  std::vector<sc::Vec3> corners;
  for (const sc::Triangle& t : scene.shape.back())
    corners.insert(corners.end(), t.vertex.begin(), t.vertex.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  scene.occluders.add_solid_hulls(corners, std::vector<std::size_t>{0, corners.size()});

  // A shelf is not solid, but three boards with air between them: one group of triangles.
  scene.shape.push_back(triangles_of(shelf, whole));
  const sc::TriangleStream stream{std::span<const sc::Triangle>(scene.shape.back())};
  scene.occluders.add_triangles(stream.view(), std::vector<std::size_t>{0, stream.size()});
}
// [[end]]

// [[rays]]
// Whether a segment passes through a triangle.
inline bool meets(const Point& from, const Point& to, const sc::Triangle& triangle) {
  const Point a = point(triangle.vertex[0]);
  const Point u = point(triangle.vertex[1]) - a;
  const Point v = point(triangle.vertex[2]) - a;
  const Point way = to - from;
  const Point p = cross(way, v);
  const double det = dot(u, p);
  if (std::fabs(det) < 1e-12) return false;
  const Point s = from - a;
  const double x = dot(s, p) / det;
  const Point q = cross(s, u);
  const double y = dot(way, q) / det;
  const double t = dot(v, q) / det;
  return x >= 0 && y >= 0 && x + y <= 1 && t > 1e-6 && t < 1 - 1e-6;
}

// How much arrives at a patch of the light that the middle of another one sends to it: by rays
// to the middles of n * n equal parts, against candidates alone.
inline double share(const Scene& scene, std::size_t from, std::size_t to,
                    std::span<const std::uint32_t> candidates) {
  constexpr int n = 4;
  const sc::Triangle& target = scene.mesh[to];
  const Point start = mix(scene.mesh[from], 1 / 3.0, 1 / 3.0);
  const Point normal = normal_of(scene.mesh[from]);
  const Point opposite = normal_of(target);
  double all = 0;
  double free = 0;
  for (int ray = 0; ray != n * n; ++ray) {
    const int row = ray / n;
    const int column = ray % n;
    const Point end = row + column < n
                          ? mix(target, (column + 1 / 3.0) / n, (row + 1 / 3.0) / n)
                          : mix(target, (n - column - 1 / 3.0) / n, (n - row - 1 / 3.0) / n);
    const Point way = end - start;
    const double light = std::max(0.0, dot(way, normal)) * std::max(0.0, -dot(way, opposite)) /
                         std::pow(dot(way, way), 2);
    const auto is_in_the_way = [&](std::uint32_t occluder) {
      const auto is_met = [&](const sc::Triangle& t) { return meets(start, end, t); };
      return std::any_of(scene.shape[occluder].begin(), scene.shape[occluder].end(), is_met);
    };
    all += light;
    if (light > 0 && std::none_of(candidates.begin(), candidates.end(), is_in_the_way))
      free += light;
  }
  return all > 0 ? free / all : 0;
}
// [[end]]
