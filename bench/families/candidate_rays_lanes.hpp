// SPDX-License-Identifier: MIT
/// The rays of candidate_rays.hpp in packets, compiled for each instruction set. Loops over a packet are vectors.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "families/candidate_rays.hpp"

namespace shaftcull::bench {

inline constexpr unsigned ray_packet = 16;

struct alignas(64) RayLanes {
  float lane[ray_packet];
  float& operator[](unsigned i) noexcept { return lane[i]; }
  float operator[](unsigned i) const noexcept { return lane[i]; }
};

/// The middle of each ray, and half of it from there.
struct RayPacket {
  RayLanes middle[3];
  RayLanes half[3];
  RayLanes rise;  ///< above both planes, of the end that is lower; negative behind one of them
};

/// `Set` tells instruction sets apart, so that the linker cannot take the code of one for that of another.
template <class Set>
struct CandidateRays {
  static RayPacket packet_of(const RayEnds& ends, const ShadowRays& rays, unsigned first) noexcept {
    const ShadowRays::Points& of_a = ends.a.triangle ? rays.on_triangle[0] : rays.on_rectangle[0];
    const ShadowRays::Points& of_b = ends.b.triangle ? rays.on_triangle[1] : rays.on_rectangle[1];
    const float* const ua = &of_a[0][first];
    const float* const va = &of_a[1][first];
    const float* const ub = &of_b[0][first];
    const float* const vb = &of_b[1][first];
    RayPacket packet;
    RayLanes above_a{};
    RayLanes above_b{};
    for (unsigned k = 0; k != 3; ++k) {
      for (unsigned i = 0; i != ray_packet; ++i) {
        const float from = ends.a.corner[k] + ua[i] * ends.a.across[k] + va[i] * ends.a.up[k];
        const float to = ends.b.corner[k] + ub[i] * ends.b.across[k] + vb[i] * ends.b.up[k];
        packet.middle[k][i] = from + 0.5F * (to - from);
        packet.half[k][i] = (0.5F - ray_margin) * (to - from);
        above_a[i] += ends.plane_a.normal[k] * to;
        above_b[i] += ends.plane_b.normal[k] * from;
      }
    }
    for (unsigned i = 0; i != ray_packet; ++i) {
      const float a = above_a[i] - ends.plane_a.offset;
      const float b = above_b[i] - ends.plane_b.offset;
      packet.rise[i] = a < b ? a : b;
    }
    return packet;
  }

  /// By how much an axis separates each ray from the box: negative if none does. S. Gottschalk, M. Lin, D. Manocha:
  /// OBBTree, 1996, with a segment for one of the boxes.
  static RayLanes separation(const RayPacket& packet, const RayBox& box) noexcept {
    const float c = box.cosine;
    const float s = box.sine;
    const float ex = box.half[0];
    const float ey = box.half[1];
    const float ez = box.half[2];
    RayLanes result;
    for (unsigned i = 0; i != ray_packet; ++i) {
      const float dx = packet.middle[0][i] - box.centre[0];
      const float dy = packet.middle[1][i] - box.centre[1];
      const float mz = packet.middle[2][i] - box.centre[2];
      const float mx = c * dx + s * dy;
      const float my = c * dy - s * dx;
      const float hx = c * packet.half[0][i] + s * packet.half[1][i];
      const float hy = c * packet.half[1][i] - s * packet.half[0][i];
      const float hz = packet.half[2][i];
      const float ax = std::abs(hx);
      const float ay = std::abs(hy);
      const float az = std::abs(hz);
      const float by_x = std::abs(mx) - (ex + ax);
      const float by_y = std::abs(my) - (ey + ay);
      const float by_z = std::abs(mz) - (ez + az);
      const float by_yz = std::abs(my * hz - mz * hy) - (ey * az + ez * ay);
      const float by_zx = std::abs(mz * hx - mx * hz) - (ez * ax + ex * az);
      const float by_xy = std::abs(mx * hy - my * hx) - (ex * ay + ey * ax);
      float most = by_x;
      most = most < by_y ? by_y : most;
      most = most < by_z ? by_z : most;
      most = most < by_yz ? by_yz : most;
      most = most < by_zx ? by_zx : most;
      most = most < by_xy ? by_xy : most;
      result[i] = most;
    }
    return result;
  }

  static CandidateCounts trace(const RayEnds& ends, const ShadowRays& rays, std::span<const RayBox> boxes,
                               std::span<const std::uint32_t> candidates, bool* maybe) noexcept {
    CandidateCounts counts{0, 0, 0};
    for (unsigned first = 0; first != rays.count; first += ray_packet) {
      const RayPacket packet = packet_of(ends, rays, first);
      // By how much a ray is apart from the nearest box: of those that are solid, and of the others.
      RayLanes from_solids;
      RayLanes from_meshes;
      for (unsigned i = 0; i != ray_packet; ++i) {
        from_solids[i] = packet.rise[i] > 0 ? std::numeric_limits<float>::infinity() : -1;
        from_meshes[i] = std::numeric_limits<float>::infinity();
      }
      for (const std::uint32_t candidate : candidates) {
        const RayBox& box = boxes[candidate];
        const RayLanes apart = separation(packet, box);
        RayLanes& nearest = box.solid ? from_solids : from_meshes;
        int left = 0;
        for (unsigned i = 0; i != ray_packet; ++i) {
          nearest[i] = apart[i] < nearest[i] ? apart[i] : nearest[i];
          left += nearest[i] >= 0 ? 1 : 0;
        }
        if (left == 0 && box.solid) break;
      }
      int traced = 0;
      int past_solids = 0;
      int maybes = 0;
      for (unsigned i = 0; i != ray_packet; ++i) {
        const int past = from_solids[i] >= 0 ? 1 : 0;
        const int meets = from_meshes[i] < 0 ? past : 0;
        traced += packet.rise[i] > 0 ? 1 : 0;
        past_solids += past;
        maybes += meets;
        maybe[first + i] = meets != 0;
      }
      counts.traced += static_cast<unsigned>(traced);
      counts.clear += static_cast<unsigned>(past_solids - maybes);
      counts.maybe += static_cast<unsigned>(maybes);
    }
    return counts;
  }
};

}  // namespace shaftcull::bench
