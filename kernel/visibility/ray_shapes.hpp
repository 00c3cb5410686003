// SPDX-License-Identifier: MIT
/// Patches and occluders as rays meet them.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/rays/ray_packet.hpp"
#include "kernels/siblings/siblings.hpp"
#include "visibility/embree_groups.hpp"
#include "visibility/ray_trees.hpp"

namespace shaftcull::kernel {

class PatchTree;
struct OccluderData;

#if defined(SHAFTCULL_WITH_EMBREE) && SHAFTCULL_WITH_EMBREE
using LargeGroups = EmbreeGroups;
#else
using LargeGroups = RayTrees;
#endif

/// What rays meet of each occluder.
struct RayShapes {
  enum class Kind : std::uint8_t {
    nothing,      ///< of a hull without an interior
    box,          ///< the occluder's box
    body,         ///< `count` planes
    tree,         ///< some triangles, below a node
    large_group,  ///< many triangles, in one of `large_groups`
  };
  struct Shape {
    Kind kind;
    std::uint32_t first;  ///< plane, node or large group
    std::uint32_t count;
  };
  /// A box around triangles: `count` of them from `first` on, or if that is 0, those of the nodes `first` and behind
  /// it.
  struct Node {
    BoxRow box;
    std::uint32_t first;
    std::uint32_t count;
  };

  std::vector<Shape> shapes;  ///< one for each occluder
  std::vector<RayPlane> planes;
  std::vector<RayTriangle> triangles;
  std::vector<Node> nodes;
  LargeGroups large_groups;
  /// What joined() to another box is that box.
  static constexpr Box nothing{{HUGE_VALF, HUGE_VALF, HUGE_VALF}, {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};
  Box around = nothing;  ///< all occluders

  /// A flat box is the rectangle that it is. O(n log n).
  explicit RayShapes(const OccluderData& occluders);

 private:
  class Growing;
};

/// Patches, by their indices.
struct RayPatches {
  std::vector<RayPatch> patches;
  Box around = RayShapes::nothing;  ///< all of them

  /// Throws InvalidArgument, with the position, for a patch that is a box with an interior.
  explicit RayPatches(const PatchTree& tree);
};

}  // namespace shaftcull::kernel
