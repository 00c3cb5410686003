// SPDX-License-Identifier: MIT
/// Small meshes made of polygons.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {

/// Triangles, and ways to add more. A polygon has its corners counterclockwise as seen from its front, and becomes the
/// triangles that its first corner forms with its other edges.
struct Polygons {
  std::vector<Triangle> triangles;

  void add(std::span<const Vec3> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({{corners[0], corners[i - 1], corners[i]}});
  }
  void add(std::initializer_list<Vec3> corners) { add(std::span(corners.begin(), corners.size())); }

  /// Walls, floor and ceiling of an outline that runs counterclockwise as seen from above. Faces look outwards.
  void add_prism(std::span<const std::pair<float, float>> outline, float low, float high) {
    std::vector<Vec3> top;
    std::vector<Vec3> bottom;
    for (std::size_t i = 0; i != outline.size(); ++i) {
      const auto& [x, y] = outline[i];
      const auto& [to_x, to_y] = outline[(i + 1) % outline.size()];
      add({{x, y, low}, {to_x, to_y, low}, {to_x, to_y, high}, {x, y, high}});
      top.push_back({x, y, high});
      bottom.push_back({x, y, low});
    }
    std::reverse(bottom.begin() + 1, bottom.end());
    add(top);
    add(bottom);
  }
  void add_box(const Box& box) {
    const std::pair<float, float> outline[]{
        {box.lo[0], box.lo[1]}, {box.hi[0], box.lo[1]}, {box.hi[0], box.hi[1]}, {box.lo[0], box.hi[1]}};
    add_prism(outline, box.lo[2], box.hi[2]);
  }
  /// Two legs around the corner at (x, y): one box of 4 × 2 and one of 2 × 4 metres.
  void add_l_block(float x, float y, float low, float high) {
    // The inner corner comes first: it sees all others.
    const std::pair<float, float> outline[]{{x + 2, y + 2}, {x + 2, y + 4}, {x, y + 4},
                                            {x, y},         {x + 4, y},     {x + 4, y + 2}};
    add_prism(outline, low, high);
  }
  void add_column(float x, float y, float radius, unsigned sides, float low, float high) {
    std::vector<std::pair<float, float>> outline;
    for (unsigned i = 0; i != sides; ++i) {
      const double angle = 2 * 3.14159265358979323846 * i / sides;
      outline.emplace_back(x + static_cast<float>(radius * std::cos(angle)),
                           y + static_cast<float>(radius * std::sin(angle)));
    }
    add_prism(outline, low, high);
  }

  /// Turns all faces around.
  void flip() {
    for (Triangle& triangle : triangles) std::swap(triangle.vertex[0], triangle.vertex[1]);
  }
  /// Turns everything by an angle about the z axis, and by another one about the x axis; coordinates are rounded.
  void turn(double about_z, double about_x) {
    for (Triangle& triangle : triangles) {
      for (Vec3& v : triangle.vertex) {
        const double x = std::cos(about_z) * v[0] - std::sin(about_z) * v[1];
        const double y = std::sin(about_z) * v[0] + std::cos(about_z) * v[1];
        const double up = std::sin(about_x) * y + std::cos(about_x) * v[2];
        v = {static_cast<float>(x), static_cast<float>(std::cos(about_x) * y - std::sin(about_x) * v[2]),
             static_cast<float>(up)};
      }
    }
  }
};

}  // namespace shaftcull
