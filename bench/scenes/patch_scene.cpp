// SPDX-License-Identifier: MIT
#include "scenes/patch_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace shaftcull::bench {
namespace {

using Point = std::array<double, 3>;

Point in_doubles(const Vec3& p) { return {p[0], p[1], p[2]}; }

Vec3 rounded(const Point& p) { return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}; }

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point unit(const Point& p) {
  const double length = std::sqrt(dot(p, p));
  return {p[0] / length, p[1] / length, p[2] / length};
}

/// The quad 0 1 2 3 as two triangles that look the same way.
void add_quad(std::vector<Triangle>& triangles, const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  triangles.push_back({{p0, p1, p2}});
  triangles.push_back({{p0, p2, p3}});
}

/// The twelve triangles of a box, seen from outside counterclockwise.
void add_faces(std::vector<Triangle>& triangles, const TurnedBox& c) {
  for (std::size_t k = 0; k != 3; ++k) {
    const std::size_t side = std::size_t{1} << k;
    const std::size_t u = std::size_t{1} << (k + 1) % 3;
    const std::size_t v = std::size_t{1} << (k + 2) % 3;
    add_quad(triangles, c[0], c[v], c[u + v], c[u]);
    add_quad(triangles, c[side], c[side + u], c[side + u + v], c[side + v]);
  }
}

/// The plane of this normal that has all points on it or behind it, as near as floats allow.
Plane plane_before(const Vec3& normal, std::span<const Vec3> points) {
  double offset = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) {
    // Products of two floats are doubles. Their sum is rounded, unless there is but one.
    const Point terms{static_cast<double>(normal[0]) * static_cast<double>(p[0]),
                      static_cast<double>(normal[1]) * static_cast<double>(p[1]),
                      static_cast<double>(normal[2]) * static_cast<double>(p[2])};
    const auto zeros = std::count(normal.begin(), normal.end(), 0.0F);
    const double error = zeros == 2 ? 0 : 0x1p-50 * (std::abs(terms[0]) + std::abs(terms[1]) + std::abs(terms[2]));
    offset = std::max(offset, terms[0] + terms[1] + terms[2] + error);
  }
  auto least = static_cast<float>(offset);
  if (static_cast<double>(least) < offset) least = std::nextafter(least, std::numeric_limits<float>::infinity());
  return {normal, least};
}

/// The triangles of an icosahedron, its corners on the unit sphere.
std::array<std::array<Point, 3>, 20> icosahedron() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const std::array<Point, 12> corners{{{-1, golden, 0},
                                       {1, golden, 0},
                                       {-1, -golden, 0},
                                       {1, -golden, 0},
                                       {0, -1, golden},
                                       {0, 1, golden},
                                       {0, -1, -golden},
                                       {0, 1, -golden},
                                       {golden, 0, -1},
                                       {golden, 0, 1},
                                       {-golden, 0, -1},
                                       {-golden, 0, 1}}};
  constexpr std::array<std::array<std::size_t, 3>, 20> faces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  std::array<std::array<Point, 3>, 20> triangles{};
  for (std::size_t f = 0; f != 20; ++f) {
    for (std::size_t i = 0; i != 3; ++i) triangles[f][i] = unit(corners[faces[f][i]]);
  }
  return triangles;
}

/// An icosahedron whose edges are cut into `pieces`, all corners on the unit sphere.
std::vector<std::array<Point, 3>> geodesic_sphere(unsigned pieces) {
  std::vector<std::array<Point, 3>> triangles;
  for (const auto& [a, b, c] : icosahedron()) {
    const auto corner = [&a = a, &b = b, &c = c, pieces](unsigned i, unsigned j) {
      Point p{};
      for (std::size_t k = 0; k != 3; ++k) p[k] = a[k] * (pieces - i - j) + b[k] * i + c[k] * j;
      return unit(p);
    };
    for (unsigned i = 0; i != pieces; ++i) {
      for (unsigned j = 0; i + j != pieces; ++j) {
        triangles.push_back({corner(i, j), corner(i + 1, j), corner(i, j + 1)});
        if (i + j + 1 != pieces) triangles.push_back({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
    }
  }
  return triangles;
}

/// Of a triangle whose corners are seen counterclockwise, of length 1.
Point normal_of(const std::array<Point, 3>& t) {
  Point u{};
  Point v{};
  for (std::size_t k = 0; k != 3; ++k) {
    u[k] = t[1][k] - t[0][k];
    v[k] = t[2][k] - t[0][k];
  }
  return unit({u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]});
}

Vec3 placed(const Vec3& centre, double scale, const Point& direction) {
  Point p{};
  for (std::size_t k = 0; k != 3; ++k) p[k] = static_cast<double>(centre[k]) + scale * direction[k];
  return rounded(p);
}

}  // namespace

TurnedBox corners_of(const Box& box) {
  TurnedBox corners{};
  for (std::size_t i = 0; i != 8; ++i) {
    for (std::size_t k = 0; k != 3; ++k) corners[i][k] = (i >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
  }
  return corners;
}

unsigned PatchSize::pieces(double length) const noexcept {
  return finer * std::max(1U, static_cast<unsigned>(std::lround(length / static_cast<double>(edge))));
}

// A point of the circle by the tangent of half its angle, which needs no library function that machines differ in.
Turn::Turn(double share) noexcept
    : cosine((1 - share * share) / (1 + share * share)), sine(2 * share / (1 + share * share)) {}

TurnedBox turned_box(const std::array<double, 2>& at, const std::array<double, 2>& half, double bottom, double top,
                     const Turn& turn) {
  TurnedBox corners{};
  for (std::size_t i = 0; i != 8; ++i) {
    const double x = (i & 1U) != 0 ? half[0] : -half[0];
    const double y = (i & 2U) != 0 ? half[1] : -half[1];
    corners[i] = rounded({at[0] + turn.cosine * x - turn.sine * y, at[1] + turn.sine * x + turn.cosine * y,
                          (i & 4U) != 0 ? top : bottom});
  }
  return corners;
}

void PatchSceneMaker::add_box(const Box& box) {
  scene_.boxes.push_back(box);
  add_faces(of_boxes_, corners_of(box));
}

void PatchSceneMaker::add_turned(const TurnedBox& box) {
  scene_.turned.push_back(box);
  add_faces(of_turned_, box);
}

void PatchSceneMaker::cut_face(const Box& box, std::size_t axis, bool high, std::uint32_t zone) {
  const TurnedBox c = corners_of(box);
  const std::size_t side = high ? std::size_t{1} << axis : 0;
  std::size_t u = std::size_t{1} << (axis + 1) % 3;
  std::size_t v = std::size_t{1} << (axis + 2) % 3;
  if (!high) std::swap(u, v);
  Vec3 normal{};
  normal[axis] = high ? 1.0F : -1.0F;
  cut({c[side], c[side + u], c[side + v]}, normal, c, zone);
}

void PatchSceneMaker::cut_face(const TurnedBox& box, const Turn& turn, std::size_t axis, bool high,
                               std::uint32_t zone) {
  const std::size_t side = high ? std::size_t{1} << axis : 0;
  std::size_t u = std::size_t{1} << (axis + 1) % 3;
  std::size_t v = std::size_t{1} << (axis + 2) % 3;
  if (!high) std::swap(u, v);
  const double sign = high ? 1 : -1;
  const std::array<Point, 3> normals{
      {{sign * turn.cosine, sign * turn.sine, 0}, {-sign * turn.sine, sign * turn.cosine, 0}, {0, 0, sign}}};
  cut({box[side], box[side + u], box[side + v]}, rounded(normals[axis]), box, zone);
}

void PatchSceneMaker::cut(const Quad& quad, const Vec3& normal, std::span<const Vec3> behind, std::uint32_t zone) {
  const Point from = in_doubles(quad.from);
  Point across = in_doubles(quad.across);
  Point up = in_doubles(quad.up);
  for (std::size_t k = 0; k != 3; ++k) {
    across[k] -= from[k];
    up[k] -= from[k];
  }
  const unsigned columns = size_.pieces(std::sqrt(dot(across, across)));
  const unsigned rows = size_.pieces(std::sqrt(dot(up, up)));
  const auto corner = [&](unsigned i, unsigned j) {
    Point p{};
    for (std::size_t k = 0; k != 3; ++k) p[k] = from[k] + across[k] * i / columns + up[k] * j / rows;
    return rounded(p);
  };
  for (unsigned i = 0; i != columns; ++i) {
    for (unsigned j = 0; j != rows; ++j) {
      const Vec3 fourth = corner(i + 1, j + 1);
      const std::array<Vec3, 3> corners{corner(i, j), corner(i + 1, j), corner(i, j + 1)};
      std::vector<Vec3> points(behind.begin(), behind.end());
      points.insert(points.end(), corners.begin(), corners.end());
      points.push_back(fourth);
      add_patch(corners, fourth, false, plane_before(normal, points), zone);
    }
  }
}

void PatchSceneMaker::add_patch(const std::array<Vec3, 3>& corners, const Vec3& fourth, bool triangle,
                                const Plane& plane, std::uint32_t zone) {
  const Vec3& from = corners[0];
  Patch patch{from, {}, {}, triangle};
  Box box{fourth, fourth};
  for (std::size_t k = 0; k != 3; ++k) {
    patch.across[k] = corners[1][k] - from[k];
    patch.up[k] = corners[2][k] - from[k];
    for (const Vec3& corner : corners) {
      box.lo[k] = std::min(box.lo[k], corner[k]);
      box.hi[k] = std::max(box.hi[k], corner[k]);
    }
  }
  scene_.patches.push_back(patch);
  scene_.patch_boxes.push_back(box);
  scene_.patch_planes.push_back(plane);
  scene_.zone.push_back(zone);
}

void PatchSceneMaker::add_sphere(const Vec3& centre, float radius, unsigned meshed, std::uint32_t zone) {
  std::vector<Vec3> vertices;
  for (const std::array<Point, 3>& t : geodesic_sphere(meshed)) {
    Triangle triangle{};
    for (std::size_t i = 0; i != 3; ++i) triangle.vertex[i] = placed(centre, static_cast<double>(radius), t[i]);
    of_meshes_.push_back(triangle);
    vertices.insert(vertices.end(), triangle.vertex.begin(), triangle.vertex.end());
  }
  mesh_ends_.push_back(static_cast<std::uint32_t>(of_meshes_.size()));

  // Faces of the coarse sphere are chords, cut twice as finely as flat surfaces so that it does not stand out far. It
  // is so much larger that they are all outside of the fine one.
  const auto coarse = geodesic_sphere(size_.pieces(2.1 * static_cast<double>(radius)));
  double nearest = 1;
  for (const std::array<Point, 3>& t : coarse) nearest = std::min(nearest, dot(normal_of(t), t[0]));
  const double scale = 1.0001 * static_cast<double>(radius) / nearest;
  for (const std::array<Point, 3>& t : coarse) {
    const std::array<Vec3, 3> corners{placed(centre, scale, t[0]), placed(centre, scale, t[1]),
                                      placed(centre, scale, t[2])};
    // All of the sphere is behind its face, so that the corners of the patch are all that the plane is to be before.
    add_patch(corners, corners[0], true, plane_before(rounded(normal_of(t)), corners), zone);
  }
}

PatchScene PatchSceneMaker::take() {
  constexpr std::size_t faces = 12;
  for (const std::vector<Triangle>* solids : {&of_boxes_, &of_turned_}) {
    for (std::size_t first = 0; first != solids->size(); first += faces) {
      scene_.objects.push_back(scene_.objects.back() + static_cast<std::uint32_t>(faces));
    }
    scene_.triangles.insert(scene_.triangles.end(), solids->begin(), solids->end());
  }
  const std::uint32_t before = scene_.objects.back();
  for (const std::uint32_t end : mesh_ends_) scene_.objects.push_back(before + end);
  scene_.triangles.insert(scene_.triangles.end(), of_meshes_.begin(), of_meshes_.end());
  return std::exchange(scene_, {});
}

}  // namespace shaftcull::bench
