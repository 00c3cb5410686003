// SPDX-License-Identifier: MIT
/// A tree of many triangles, as rays go through it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/rays/ray_packet.hpp"

namespace shaftcull::kernel {

/// Children of a node, and triangles of a leaf: as many as the widest instruction set has lanes.
inline constexpr unsigned tree_lanes = 16;

/// Triangles, as those of RayTriangle. Where there are fewer than sixteen, the others are 0, which no ray passes
/// through.
struct alignas(64) RayTreeLeaf {
  float point[3][tree_lanes];
  float normal[3][tree_lanes];
  float across_u[3][tree_lanes];
  float across_v[3][tree_lanes];

  [[nodiscard]] RayTriangle triangle(std::size_t i) const noexcept {
    return {{point[0][i], point[1][i], point[2][i]},
            {normal[0][i], normal[1][i], normal[2][i]},
            {across_u[0][i], across_u[1][i], across_u[2][i]},
            {across_v[0][i], across_v[1][i], across_v[2][i]}};
  }
};

struct alignas(64) RayTreeNode {
  float face[6][tree_lanes];           ///< of the box around each child
  std::uint32_t child[tree_lanes];     ///< a node or a leaf
  std::uint8_t triangles[tree_lanes];  ///< of a leaf; 0 of a node
  std::uint32_t children;              ///< how many there are
  std::uint32_t leaves;                ///< a bit for each child that is a leaf
};

struct RayTree {
  /// Nodes that wait are 15 a level, and each level halves the triangles at least.
  static constexpr unsigned most_waiting = 512;

  const RayTreeNode* nodes;
  const RayTreeLeaf* leaves;
};

}  // namespace shaftcull::kernel
