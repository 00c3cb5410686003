// SPDX-License-Identifier: MIT
/// The faces and edges of the convex hull of any number of points, exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/near_plane.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Points are added one by one: each takes the place of the triangles that it is in front of, as seen from there. Signs
/// of determinants decide alone, so the hull is that of the floats given. Points in one plane are in one face.
class HullMesh {
 public:
  /// A piece of an edge, or all of it. It runs counterclockwise around face `left`, and clockwise around face `right`.
  struct Edge {
    Vec3 from;
    Vec3 to;
    std::uint32_t left;
    std::uint32_t right;
  };

  /// The hull of finite points. It has no faces if all points are in one plane. O(n²) at worst; allocates.
  explicit HullMesh(std::span<const Vec3> points);
  /// No hull yet.
  HullMesh() noexcept = default;
  /// Becomes the hull of a box of six faces that is not flat. Memory is kept from one box to the next.
  void become(const float (&box)[6]);

  [[nodiscard]] bool has_interior() const noexcept { return !faces_.empty(); }
  /// Planes through three corners each, with their front outside. No two faces are in one plane.
  [[nodiscard]] std::span<const NearPlane> faces() const noexcept { return faces_; }
  [[nodiscard]] std::span<const Edge> edges() const noexcept { return edges_; }
  /// How far the points are from the middle of the box around them at most, but for 2⁻⁴⁰ of it. Of a box, 0.
  [[nodiscard]] double radius() const noexcept { return radius_; }

 private:
  std::vector<NearPlane> faces_;
  std::vector<Edge> edges_;
  double radius_ = 0;
};

}  // namespace shaftcull::kernel
