// SPDX-License-Identifier: MIT
/// Rooms and what stands in them, as patches and as triangles.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// Quadrilaterals that radiate, and the triangles that they consist of.
struct RadiatingScene {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  std::vector<Triangle> triangles;

  [[nodiscard]] std::size_t size() const noexcept { return first.size() - 1; }
  [[nodiscard]] PatchSet patches() const { return PatchSet(corners, first); }
  /// All triangles, and what is found in them.
  [[nodiscard]] Occluders occluders() const {
    Occluders occluders;
    const TriangleStream stream(triangles);
    occluders.add_triangles(stream.view());
    occluders.add_found(find_solids(stream.view()));
    return occluders;
  }
  [[nodiscard]] std::vector<Vec3> patch(std::size_t i) const {
    const auto at = [&](std::size_t c) { return corners.begin() + static_cast<std::ptrdiff_t>(c); };
    return {at(first[i]), at(first[i + 1])};
  }

  void add(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    for (const Vec3& corner : {p, q, r, s}) corners.push_back(corner);
    first.push_back(corners.size());
    triangles.push_back({{p, q, r}});
    triangles.push_back({{p, r, s}});
  }

  /// The six sides of a box, each cut into n × n, which face inwards or outwards.
  void add_box(const Box& box, std::size_t n, bool inwards) {
    for (std::size_t axis = 0; axis != 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      for (const bool is_far : {false, true}) {
        for (std::size_t i = 0; i != n * n; ++i) {
          const auto at = [&](std::size_t column, std::size_t row) {
            const auto place = [&](std::size_t k, std::size_t part) {
              return box.lo[k] + (box.hi[k] - box.lo[k]) * static_cast<float>(part) / static_cast<float>(n);
            };
            Vec3 corner{};
            corner[axis] = is_far ? box.hi[axis] : box.lo[axis];
            corner[u] = place(u, i % n + column);
            corner[v] = place(v, i / n + row);
            return corner;
          };
          if (is_far == inwards) {
            add(at(0, 0), at(0, 1), at(1, 1), at(1, 0));
          } else {
            add(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
          }
        }
      }
    }
  }
};

/// A room of 6 × 5 × 3 with four boxes in it.
inline RadiatingScene furnished_room(std::size_t n) {
  RadiatingScene scene;
  scene.add_box({{0, 0, 0}, {6, 5, 3}}, 2 * n, true);
  scene.add_box({{1, 1, 0}, {2, 2, 1}}, n, false);
  scene.add_box({{3, 1, 0}, {5, 2, 0.75F}}, n, false);
  scene.add_box({{2.5F, 3, 0}, {3.5F, 4, 2}}, n, false);
  scene.add_box({{4.5F, 3.5F, 0.5F}, {5.5F, 4.5F, 1}}, n, false);
  return scene;
}

}  // namespace shaftcull
