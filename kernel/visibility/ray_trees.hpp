// SPDX-License-Identifier: MIT
/// Trees of many triangles, for rays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/rays/ray_packet.hpp"
#include "kernels/rays/ray_tree.hpp"
#include "kernels/siblings/siblings.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::kernel {

using TriangleVertices = std::array<Vec3, 3>;

/// Writes a triangle as rays test it, and returns whether it has an area.
[[nodiscard]] bool make_ray_triangle(const TriangleVertices& vertices, RayTriangle& triangle) noexcept;

[[nodiscard]] BoxRow box_around(std::span<const TriangleVertices> triangles) noexcept;

/// Cuts triangles in two along the longest axis of the box around them, so that the first part has so many.
void cut_in_two(std::span<TriangleVertices> triangles, const BoxRow& box, std::size_t first_part);

class RayTrees {
 public:
  /// Makes a tree of triangles that have areas, puts them in another order, and returns its root. O(n log n).
  std::uint32_t add(std::span<TriangleVertices> triangles);

  /// As meet_tree() of RayKernels.
  [[nodiscard]] std::uint64_t meet(const RayKernels& kernels, const RayPacket& packet, std::uint32_t root, float margin,
                                   std::uint64_t asked) const noexcept {
    return kernels.meet_tree(packet, {nodes_.data(), leaves_.data()}, root, margin, asked);
  }

 private:
  void fill(std::uint32_t node, std::span<TriangleVertices> triangles);
  std::uint32_t add_leaf(std::span<const TriangleVertices> triangles);

  std::vector<RayTreeNode> nodes_;
  std::vector<RayTreeLeaf> leaves_;
};

}  // namespace shaftcull::kernel
