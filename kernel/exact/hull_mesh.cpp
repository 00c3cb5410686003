// SPDX-License-Identifier: MIT
#include "exact/hull_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "exact/orientation.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::uint32_t no_triangle = ~std::uint32_t{0};

/// Edge i runs from vertex i to the next one; `across[i]` is the triangle on its other side. A triangle that is hidden
/// inside has no vertices that differ.
struct HullTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<std::uint32_t, 3> across{};

  [[nodiscard]] bool is_hidden() const noexcept { return vertex[0] == vertex[1]; }
  [[nodiscard]] std::size_t edge_from(std::uint32_t start) const noexcept {
    return vertex[0] == start ? 0 : vertex[1] == start ? 1 : 2;
  }
};

class HullConstruction {
 public:
  explicit HullConstruction(std::span<const Vec3> points) : points_(points), triangle_from_(points.size()) {
    if (!begin()) return;
    for (std::uint32_t p = 0; p != points_.size(); ++p) add(p);
  }

  [[nodiscard]] std::span<const HullTriangle> triangles() const noexcept { return triangles_; }
  [[nodiscard]] int side(const HullTriangle& triangle, std::uint32_t point) const noexcept {
    const auto& [a, b, c] = triangle.vertex;
    return side_of(plane_of(points_[a], points_[b], points_[c]), points_[point]);
  }

 private:
  /// A tetrahedron of four of the points, if they are not all in one plane.
  bool begin() {
    const auto first = [&](const auto& suits) {
      std::uint32_t p = 0;
      while (p != points_.size() && !suits(points_[p])) ++p;
      return p;
    };
    const auto end = static_cast<std::uint32_t>(points_.size());
    const std::uint32_t b = first([&](const Vec3& x) { return x != points_[0]; });
    if (b == end) return false;
    const std::uint32_t c = first([&](const Vec3& x) { return !are_on_one_line(points_[0], points_[b], x); });
    if (c == end) return false;
    const SpannedPlane plane = plane_of(points_[0], points_[b], points_[c]);
    const std::uint32_t d = first([&](const Vec3& x) { return side_of(plane, x) != 0; });
    if (d == end) return false;
    const bool is_in_front = side_of(plane, points_[d]) > 0;
    const std::array<std::uint32_t, 3> base{0, is_in_front ? c : b, is_in_front ? b : c};
    // Triangle 0 is seen from the side away from d. Triangle 1 + i is across its edge i.
    triangles_.push_back({base, {1, 2, 3}});
    for (std::uint32_t i = 0; i != 3; ++i) {
      triangles_.push_back({{base[(i + 1) % 3], base[i], d}, {0, 1 + (i + 2) % 3, 1 + (i + 1) % 3}});
    }
    return true;
  }

  /// Puts triangles from the horizon, as seen from a point, to the point in place of those that are seen from there.
  void add(std::uint32_t point) {
    seen_.clear();
    is_seen_.assign(triangles_.size(), false);
    for (std::uint32_t t = 0; t != triangles_.size(); ++t) {
      if (triangles_[t].is_hidden() || side(triangles_[t], point) <= 0) continue;
      seen_.push_back(t);
      is_seen_[t] = true;
    }
    if (seen_.empty()) return;
    // The horizon is one ring, which passes each vertex once.
    horizon_.clear();
    for (const std::uint32_t t : seen_) {
      for (std::size_t i = 0; i != 3; ++i) {
        const std::uint32_t beyond = triangles_[t].across[i];
        if (is_seen_[beyond]) continue;
        horizon_.push_back({triangles_[t].vertex[i], triangles_[t].vertex[(i + 1) % 3], beyond});
      }
    }
    for (const std::uint32_t t : seen_) {
      triangles_[t] = {};
      free_.push_back(t);
    }
    for (const HorizonEdge& edge : horizon_) {
      std::uint32_t made = static_cast<std::uint32_t>(triangles_.size());
      if (free_.empty()) {
        triangles_.emplace_back();
      } else {
        made = free_.back();
        free_.pop_back();
      }
      triangles_[made] = {{edge.from, edge.to, point}, {edge.beyond, no_triangle, no_triangle}};
      HullTriangle& beyond = triangles_[edge.beyond];
      beyond.across[beyond.edge_from(edge.to)] = made;
      triangle_from_[edge.from] = made;
    }
    for (const HorizonEdge& edge : horizon_) {
      const std::uint32_t made = triangle_from_[edge.from];
      const std::uint32_t next = triangle_from_[edge.to];
      triangles_[made].across[1] = next;
      triangles_[next].across[2] = made;
    }
  }

  struct HorizonEdge {
    std::uint32_t from;
    std::uint32_t to;
    std::uint32_t beyond;  ///< the triangle that is not seen
  };

  std::span<const Vec3> points_;
  std::vector<HullTriangle> triangles_;
  std::vector<std::uint32_t> triangle_from_;  ///< of a vertex of the horizon
  std::vector<std::uint32_t> seen_;
  std::vector<bool> is_seen_;
  std::vector<std::uint32_t> free_;
  std::vector<HorizonEdge> horizon_;
};

double radius_around_middle(std::span<const Vec3> points) noexcept {
  double middle[3];
  for (std::size_t k = 0; k != 3; ++k) {
    const auto [lo, hi] =
        std::minmax_element(points.begin(), points.end(), [&](const Vec3& p, const Vec3& q) { return p[k] < q[k]; });
    middle[k] = (double{(*lo)[k]} + double{(*hi)[k]}) / 2;
  }
  double radius = 0;
  for (const Vec3& p : points) {
    radius = std::max(radius, std::hypot(p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]));
  }
  return radius;
}

}  // namespace

HullMesh::HullMesh(std::span<const Vec3> points) : radius_(radius_around_middle(points)) {
  const HullConstruction hull(points);
  const std::span<const HullTriangle> triangles = hull.triangles();
  // Triangles in one plane are one face, of which the first one stands for all.
  std::vector<std::uint32_t> first(triangles.size());
  std::iota(first.begin(), first.end(), std::uint32_t{0});
  const auto first_of = [&](std::uint32_t t) {
    while (first[t] != t) t = first[t] = first[first[t]];
    return t;
  };
  const auto for_each_edge = [&](const auto& visit) {  // once
    for (std::uint32_t t = 0; t != triangles.size(); ++t) {
      if (triangles[t].is_hidden()) continue;
      for (std::size_t i = 0; i != 3; ++i) {
        if (t < triangles[t].across[i]) visit(t, i, triangles[t].across[i]);
      }
    }
  };
  for_each_edge([&](std::uint32_t t, std::size_t i, std::uint32_t other) {
    const HullTriangle& beyond = triangles[other];
    const std::size_t shared = beyond.edge_from(triangles[t].vertex[(i + 1) % 3]);
    if (hull.side(triangles[t], beyond.vertex[(shared + 2) % 3]) != 0) return;
    const auto [less, more] = std::minmax({first_of(t), first_of(other)});
    first[more] = less;
  });
  std::vector<std::uint32_t> face(triangles.size());
  for (std::uint32_t t = 0; t != triangles.size(); ++t) {
    if (triangles[t].is_hidden()) continue;
    if (first_of(t) == t) {
      face[t] = static_cast<std::uint32_t>(faces_.size());
      const auto& [a, b, c] = triangles[t].vertex;
      faces_.emplace_back(points[a], points[b], points[c]);
    } else {
      face[t] = face[first_of(t)];
    }
  }
  for_each_edge([&](std::uint32_t t, std::size_t i, std::uint32_t other) {
    if (face[t] == face[other]) return;
    edges_.push_back({points[triangles[t].vertex[i]], points[triangles[t].vertex[(i + 1) % 3]], face[t], face[other]});
  });
}

void HullMesh::become(const float (&box)[6]) {
  const auto corner = [&](unsigned c) {
    return Vec3{box[(c & 1U) != 0 ? 3 : 0], box[(c & 2U) != 0 ? 4 : 1], box[(c & 4U) != 0 ? 5 : 2]};
  };
  faces_.clear();
  edges_.clear();
  for (std::uint32_t f = 0; f != 6; ++f) {  // lo x, y, z, hi x, y, z
    const unsigned u = 1U << (f + 1) % 3;
    const unsigned v = 1U << (f + 2) % 3;
    const unsigned from = f < 3 ? 0 : 1U << (f - 3);
    faces_.emplace_back(corner(from), corner(from | (f < 3 ? v : u)), corner(from | (f < 3 ? u : v)));
  }
  for (std::uint32_t k = 0; k != 3; ++k) {
    const std::uint32_t u = (k + 1) % 3;
    const std::uint32_t v = (k + 2) % 3;
    for (unsigned side = 0; side != 4; ++side) {
      const bool is_hi_u = (side & 1U) != 0;
      const bool is_hi_v = (side & 2U) != 0;
      const unsigned lo = (is_hi_u ? 1U << u : 0) | (is_hi_v ? 1U << v : 0);
      const unsigned hi = lo | 1U << k;
      // n(u) × n(v) runs along the edge if both point to the same side.
      const bool runs_up = is_hi_u == is_hi_v;
      edges_.push_back(
          {corner(runs_up ? lo : hi), corner(runs_up ? hi : lo), is_hi_u ? u + 3 : u, is_hi_v ? v + 3 : v});
    }
  }
}

}  // namespace shaftcull::kernel
