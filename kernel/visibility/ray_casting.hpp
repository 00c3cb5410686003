// SPDX-License-Identifier: MIT
/// What rays between patches and rays towards lights have in common: where they begin, how many are cast, and what
/// they meet.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/kernel_table.hpp"
#include "kernels/rays/ray_packet.hpp"
#include "shaftcull/visibility.hpp"
#include "support/compiler.hpp"
#include "visibility/occluders.hpp"
#include "visibility/ray_shapes.hpp"

namespace shaftcull::kernel {

/// What became of rays.
struct RayTally {
  std::uint32_t rays = 0;
  std::uint32_t facing = 0;  ///< that leave and arrive in front
  std::uint32_t seen = 0;    ///< of these, those that meet nothing

  /// Adds a packet: a bit for each ray.
  void add(std::uint32_t count, std::uint64_t in_front, std::uint64_t unmet) noexcept {
    rays += count;
    facing += static_cast<std::uint32_t>(popcount_anywhere(in_front));
    seen += static_cast<std::uint32_t>(popcount_anywhere(unmet));
  }

  /// The share of rays that meet nothing, of those that leave and arrive in front; 0 if there are none.
  [[nodiscard]] float fraction() const noexcept {
    return facing == 0 ? 0 : static_cast<float>(seen) / static_cast<float>(facing);
  }
  /// Whether the estimated standard error of the fraction is at most `error`; never if that is 0.
  [[nodiscard]] bool is_within(double error) const noexcept {
    if (error == 0 || facing == 0) return false;
    const double part = (seen + 0.5) / (facing + 1.0);
    return part * (1 - part) <= error * error * facing;
  }
};

/// Where rays leave and arrive: points that fill so many dimensions evenly, 2 or 4. `rays` is a multiple of 16.
class RayPoints {
 public:
  RayPoints(std::uint32_t rays, std::size_t dimensions);

  [[nodiscard]] const float* stream(std::size_t s) const noexcept { return points_[s].data(); }

 private:
  std::vector<float> points_[4];
};

/// How far the points of a pair's rays are moved around the unit square. It depends on the seed and the pair alone.
struct RayShift {
  float of[4];

  RayShift(std::uint64_t seed, PatchPair pair) noexcept;
};

/// Calls cast(tally, count) for packets of rays, which adds what became of them: 16 rays first, then as many again as
/// were cast until there are `rays`, or is_enough(tally). A multiple of 16 is cast, at most `most`.
template <class Cast, class IsEnough>
[[nodiscard]] RayTally cast_rays(std::uint32_t rays, std::uint32_t most, const Cast& cast, const IsEnough& is_enough) {
  RayTally tally;
  std::uint32_t next = 16;
  while (tally.rays < rays && tally.rays < most) {
    for (std::uint32_t left = next; left != 0 && tally.rays < most;) {
      const std::uint32_t count = left < most_packet_rays ? left : most_packet_rays;
      cast(tally, count);
      left -= count;
    }
    if (is_enough(tally)) break;
    next = tally.rays;
    if (tally.rays < rays && rays - tally.rays < next) next = (rays - tally.rays + 15) / 16 * 16;
  }
  return tally;
}

/// Occluders, as rays meet them. Many threads may ask at once. It refers to the occluders.
class RayTargets {
 public:
  /// `ends` is around all that rays leave, and arrive at if that is nearby; `largest_end` is the largest magnitude of
  /// its coordinates. An occluder whose surface is nearer than `tolerance` to an end of a ray is what the end lies on.
  RayTargets(const OccluderData& occluders, const Box& ends, float largest_end, float tolerance);

  [[nodiscard]] const RayKernels& kernels() const noexcept { return kernels_; }
  /// More than any two points of occluders and ends are apart.
  [[nodiscard]] float reach() const noexcept { return reach_; }
  /// Of the rays `asked`, those that meet none of these occluders.
  [[nodiscard]] std::uint64_t unmet(const RayPacket& packet, std::span<const std::uint32_t> occluders,
                                    std::uint64_t asked) const;

 private:
  [[nodiscard]] std::uint64_t meet(const RayPacket& packet, std::uint32_t occluder, std::uint64_t asked) const;
  [[nodiscard]] std::uint64_t meet_box(const RayPacket& packet, const float (&face)[8], std::uint64_t asked) const;
  [[nodiscard]] std::uint64_t meet_body(const RayPacket& packet, std::span<const RayPlane> planes,
                                        std::uint64_t asked) const;
  [[nodiscard]] std::uint64_t meet_tree(const RayPacket& packet, std::uint32_t root, std::uint64_t asked) const;

  const OccluderData& occluders_;
  MadeOnce<RayShapes>::Shared shapes_;
  const RayKernels& kernels_;
  float margin_;
  float reach_;
};

}  // namespace shaftcull::kernel
