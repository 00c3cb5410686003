// SPDX-License-Identifier: MIT
/// Rays between two patches, and what they meet.
///
/// A ray is the segment from a point of one patch to a point of another. Rays of a pair are side by side in a packet.
/// All coordinates of a packet are relative to the first corner of the patch that rays start from: so they are as
/// precise as the distances in a scene, wherever it is.
#pragma once

#include <cstddef>
#include <cstdint>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// Most rays of a packet. It has a multiple of 16.
inline constexpr unsigned most_packet_rays = 64;

/// A patch from which rays start, or at which they arrive. Points (u, v) of the unit square are spread evenly over it.
struct RayPatch {
  float corner[3];  ///< the first one
  float normal[3];  ///< to the front
  float least_rise;  ///< what a ray's way along the normal is more than: 0, or −∞ if the patch is seen from both sides
  float edge[7][3];    ///< from the first corner to the others; of a parallelogram, to its two neighbours
  float first[6];      ///< of each triangle that the first corner forms with another edge, the share of area before it
  float inverse[6];    ///< 1 by its own share
  unsigned triangles;  ///< how many; 0 for a parallelogram
};

struct RayPacket {
  unsigned count;
  float origin[3];
  alignas(64) float from[3][most_packet_rays];
  alignas(64) float way[3][most_packet_rays];
  alignas(64) float inverse[3][most_packet_rays];  ///< of `way`
  /// cos θ₁ cos θ₂ / r², but for a factor that all rays of a pair have in common; 0 for rays that leave or arrive
  /// behind.
  alignas(64) float weight[most_packet_rays];
};

/// A plane that has a convex body behind it.
struct RayPlane {
  float point[3];
  float normal[3];  ///< outwards, of length 1
};

/// A triangle. A point h of its plane is in it if u = across_u · (h − point), v = across_v · (h − point) and 1 − u − v
/// are 0 or more.
struct RayTriangle {
  float point[3];
  float normal[3];  ///< of length 1
  float across_u[3];
  float across_v[3];
};

struct RayTree;

/// Rays are tested in lanes. Each function gives a bit for each ray of `asked`; bits of others say nothing. Results are
/// the same bits on every instruction set.
struct RayKernels {
  /// Makes a packet of `count` rays from `a` to `b`, at the points of four streams, each moved by its shift around the
  /// unit square. Bits of rays that leave and arrive in front.
  std::uint64_t (*form)(const RayPatch& a, const RayPatch& b, const float* const* points, const float* shift,
                        unsigned count, RayPacket& packet) noexcept;
  /// Rays that meet the inside of a box of six faces.
  std::uint64_t (*meet_box)(const RayPacket& packet, const float* box, std::uint64_t asked) noexcept;
  /// Rays that meet what is behind all planes by more than `margin`.
  std::uint64_t (*meet_body)(const RayPacket& packet, const RayPlane* planes, std::size_t count, float margin,
                             std::uint64_t asked) noexcept;
  /// Rays that pass through a triangle, with both ends more than `margin` from its plane.
  std::uint64_t (*meet_triangles)(const RayPacket& packet, const RayTriangle* triangles, std::size_t count,
                                  float margin, std::uint64_t asked) noexcept;
  /// Likewise through a triangle of a tree.
  std::uint64_t (*meet_tree)(const RayPacket& packet, const RayTree& tree, std::uint32_t root, float margin,
                             std::uint64_t asked) noexcept;
};

}  // namespace shaftcull::kernel
