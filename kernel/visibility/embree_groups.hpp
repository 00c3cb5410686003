// SPDX-License-Identifier: MIT
/// Large groups of triangles in Embree's trees, for rays: in place of RayTrees in builds with SHAFTCULL_WITH_EMBREE.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/rays/ray_packet.hpp"
#include "shaftcull/geometry.hpp"
#include "visibility/ray_trees.hpp"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace shaftcull::kernel {

class EmbreeGroups {
 public:
  /// Builds a tree of triangles that have areas, and returns its number. O(n log n). Threads of oneTBB help.
  std::uint32_t add(std::span<TriangleVertices> triangles);

  /// As meet_tree() of RayKernels, by Embree. Where a ray passes an edge within rounding, the answer may differ.
  [[nodiscard]] std::uint64_t meet(const RayKernels& unused, const RayPacket& packet, std::uint32_t group, float margin,
                                   std::uint64_t asked) const;

 private:
  struct Release {
    void operator()(RTCDeviceTy* device) const noexcept;
    void operator()(RTCSceneTy* scene) const noexcept;
  };
  /// Triangles are scaled, so that no coordinate is larger than 1: Embree takes squares of them.
  struct Group {
    std::unique_ptr<RTCSceneTy, Release> scene;
    Box box;      ///< larger than its triangles
    float scale;  ///< a power of 2
  };

  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::vector<Group> groups_;
};

}  // namespace shaftcull::kernel
