// SPDX-License-Identifier: MIT
/// The rays of candidate_rays.hpp over vectors of `L`, a type that only one translation unit has
/// (kernel/kernels/README.md).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "families/candidate_rays.hpp"

namespace shaftcull::bench {

template <class L>
struct CandidateRays {
  using Vector = typename L::Vector;

  /// From where each ray starts, how far it goes, and the inverse of that.
  struct Packet {
    Vector from[3];
    Vector step[3];
    Vector inverse[3];
    std::uint64_t facing;  ///< bits of those that leave and arrive in front of both planes
  };

  static Vector multiply_subtract(Vector a, Vector b, Vector c, Vector d) noexcept {
    return L::subtract(L::multiply(a, b), L::multiply(c, d));
  }

  /// One coordinate of the points of a patch, rounded as the peer's are.
  static Vector placed(const Patch& patch, std::size_t axis, const ShadowRays::Points& at, unsigned first) noexcept {
    const Vector across = L::multiply(L::load(&at[0][first]), L::all(patch.across[axis]));
    const Vector up = L::multiply(L::load(&at[1][first]), L::all(patch.up[axis]));
    return L::add(L::add(L::all(patch.corner[axis]), across), up);
  }

  static Packet packet_of(const RayEnds& ends, const ShadowRays& rays, unsigned first) noexcept {
    const ShadowRays::Points& of_a = ends.a.triangle ? rays.on_triangle[0] : rays.on_rectangle[0];
    const ShadowRays::Points& of_b = ends.b.triangle ? rays.on_triangle[1] : rays.on_rectangle[1];
    Packet packet;
    Vector above_a = L::all(0);
    Vector above_b = L::all(0);
    for (std::size_t k = 0; k != 3; ++k) {
      const Vector from = placed(ends.a, k, of_a, first);
      const Vector to = placed(ends.b, k, of_b, first);
      packet.from[k] = from;
      packet.step[k] = L::subtract(to, from);
      packet.inverse[k] = L::divide(L::all(1), packet.step[k]);
      above_a = L::add(above_a, L::multiply(L::all(ends.plane_a.normal[k]), to));
      above_b = L::add(above_b, L::multiply(L::all(ends.plane_b.normal[k]), from));
    }
    const Vector rise = L::minimum(L::subtract(above_a, L::all(ends.plane_a.offset)),
                                   L::subtract(above_b, L::all(ends.plane_b.offset)));
    packet.facing = L::bits(L::less(L::all(0), rise));
    return packet;
  }

  /// Bits of rays that meet the box. A ray in a face of it, or along one, does not. By slabs: where the ray enters the
  /// last of the three, and where it leaves the first. T. Kay, J. Kajiya: Ray Tracing Complex Scenes, 1986.
  static std::uint64_t meet_straight(const Packet& packet, const RayBox& box) noexcept {
    Vector first = L::all(ray_margin);
    Vector last = L::all(1 - ray_margin);
    for (std::size_t k = 0; k != 3; ++k) {
      const Vector low =
          L::multiply(L::subtract(L::all(box.centre[k] - box.half[k]), packet.from[k]), packet.inverse[k]);
      const Vector high =
          L::multiply(L::subtract(L::all(box.centre[k] + box.half[k]), packet.from[k]), packet.inverse[k]);
      // 0 · ∞ is no number, where the ray lies in the plane of a face: then it meets nothing.
      first = L::maximum(L::minimum(low, high), first);
      last = L::minimum(L::maximum(low, high), last);
    }
    return L::bits(L::less(first, last));
  }

  /// The same by the axes that may separate a ray from a box: S. Gottschalk, M. Lin, D. Manocha: OBBTree, 1996, with a
  /// segment for one of the boxes. It needs no divisions.
  static std::uint64_t meet_turned(const Packet& packet, const RayBox& box) noexcept {
    const Vector c = L::all(box.cosine);
    const Vector s = L::all(box.sine);
    const Vector half = L::all(0.5F);
    const Vector reach = L::all(0.5F - ray_margin);
    const auto middle = [&](std::size_t k) {
      return L::multiply_add(packet.step[k], half, L::subtract(packet.from[k], L::all(box.centre[k])));
    };
    const Vector dx = middle(0);
    const Vector dy = middle(1);
    const Vector m[3] = {L::multiply_add(c, dx, L::multiply(s, dy)), multiply_subtract(c, dy, s, dx), middle(2)};
    const Vector h[3] = {L::multiply(reach, L::multiply_add(c, packet.step[0], L::multiply(s, packet.step[1]))),
                         L::multiply(reach, multiply_subtract(c, packet.step[1], s, packet.step[0])),
                         L::multiply(reach, packet.step[2])};
    Vector size[3];
    Vector apart = L::all(-std::numeric_limits<float>::infinity());
    for (std::size_t k = 0; k != 3; ++k) {
      size[k] = L::magnitude(h[k]);
      apart = L::maximum(L::subtract(L::magnitude(m[k]), L::add(L::all(box.half[k]), size[k])), apart);
    }
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t u = (k + 1) % 3;
      const std::size_t v = (k + 2) % 3;
      const Vector across = L::magnitude(multiply_subtract(m[u], h[v], m[v], h[u]));
      const Vector sides = L::multiply_add(L::all(box.half[u]), size[v], L::multiply(L::all(box.half[v]), size[u]));
      apart = L::maximum(L::subtract(across, sides), apart);
    }
    return L::bits(L::less(apart, L::all(0)));
  }

  static CandidateCounts trace(const RayEnds& ends, const ShadowRays& rays, std::span<const RayBox> boxes,
                               std::span<const std::uint32_t> candidates, std::uint64_t* maybe) noexcept {
    CandidateCounts counts{0, 0, 0};
    for (unsigned first = 0; first != rays.count; first += L::width) {
      const Packet packet = packet_of(ends, rays, first);
      std::uint64_t past_solids = packet.facing;
      std::uint64_t meets_meshes = 0;
      for (const std::uint32_t candidate : candidates) {
        const RayBox& box = boxes[candidate];
        const std::uint64_t meets = box.sine == 0 ? meet_straight(packet, box) : meet_turned(packet, box);
        if (box.solid) {
          past_solids &= ~meets;
        } else {
          meets_meshes |= meets;
        }
        if (past_solids == 0) break;
      }
      const std::uint64_t unsure = past_solids & meets_meshes;
      if (first % 64 == 0) maybe[first / 64] = 0;
      maybe[first / 64] |= unsure << first % 64;
      counts.traced += static_cast<unsigned>(std::popcount(packet.facing));
      counts.clear += static_cast<unsigned>(std::popcount(past_solids & ~unsure));
      counts.maybe += static_cast<unsigned>(std::popcount(unsure));
    }
    return counts;
  }
};

}  // namespace shaftcull::bench
