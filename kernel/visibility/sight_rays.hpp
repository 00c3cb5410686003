// SPDX-License-Identifier: MIT
/// Rays between two patches against their candidates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernels/kernel_table.hpp"
#include "kernels/rays/ray_packet.hpp"
#include "shaftcull/visibility.hpp"
#include "visibility/occluders.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/ray_shapes.hpp"

namespace shaftcull::kernel {

/// What became of a pair's rays. Sums are in the order of the rays, so they are the same bits everywhere.
struct RayTally {
  std::uint32_t rays = 0;
  std::uint32_t facing = 0;  ///< that leave and arrive in front
  std::uint32_t seen = 0;    ///< of these, those that meet nothing
  // Of those that leave and arrive in front, the weights of RayPacket.
  double weight = 0;
  double weight_of_seen = 0;
  double square = 0;          ///< sum of squares of weights
  double square_of_seen = 0;  ///< likewise
};

/// Which part of the weight arrives, and the standard error of that.
struct SeenShare {
  double part;
  double error;

  /// Given the mean weight of all rays that there might be, those that leave or arrive behind included. Weights of the
  /// rays that were cast differ from it by chance, and what arrives differs with them: so much of it is taken back.
  /// Where patches touch, few rays have most of the weight, and this makes the error several times smaller. (A
  /// regression estimator: W. G. Cochran, "Sampling Techniques", 1977.)
  SeenShare(const RayTally& tally, double mean_weight) noexcept;
};

/// Where rays leave and arrive: points that fill four dimensions evenly, as many as were asked for.
class RayPoints {
 public:
  explicit RayPoints(std::uint32_t rays);

  [[nodiscard]] const float* stream(std::size_t s) const noexcept { return points_[s].data(); }

 private:
  std::vector<float> points_[4];
};

/// Casts rays; many threads may do so at once. It refers to what it is given.
class SightRays {
 public:
  /// Rays of a pair depend on `seed` and the pair alone. What is nearer than `tolerance` to an end of a ray is what the
  /// end lies on.
  SightRays(const PatchTree& a, const PatchTree& b, const OccluderData& occluders, float tolerance,
            std::uint32_t most_rays, std::uint64_t seed);

  /// Casts rays between two patches, by their indices, against these candidates. 16 rays first, then as many again as
  /// were cast until there are `rays`, or is_enough(tally). A multiple of 16 is cast, at most `most_rays`.
  template <class IsEnough>
  [[nodiscard]] RayTally cast(PatchPair pair, std::span<const std::uint32_t> candidates, std::uint32_t rays,
                              const IsEnough& is_enough) const {
    RayTally tally;
    const Shift shift = shift_of(pair);
    std::uint32_t next = first_rays;
    while (tally.rays < rays && tally.rays < most_rays_) {
      for (std::uint32_t left = next; left != 0 && tally.rays < most_rays_;) {
        const std::uint32_t count = left < most_packet_rays ? left : most_packet_rays;
        cast_packet(pair, shift, candidates, count, tally);
        left -= count;
      }
      if (is_enough(tally)) break;
      next = tally.rays;
      if (tally.rays < rays && rays - tally.rays < next) next = (rays - tally.rays + 15) / 16 * 16;
    }
    return tally;
  }

 private:
  static constexpr std::uint32_t first_rays = 16;
  struct Shift {
    float of[4];
  };

  [[nodiscard]] Shift shift_of(PatchPair pair) const noexcept;
  void cast_packet(PatchPair pair, const Shift& shift, std::span<const std::uint32_t> candidates, std::uint32_t count,
                   RayTally& tally) const;
  [[nodiscard]] std::uint64_t meet(const RayPacket& packet, std::uint32_t occluder, std::uint64_t asked) const;
  [[nodiscard]] std::uint64_t meet_tree(const RayPacket& packet, std::uint32_t root, std::uint64_t asked) const;

  std::shared_ptr<const RayPatches> a_;
  std::shared_ptr<const RayPatches> b_;
  const OccluderData& occluders_;
  MadeOnce<RayShapes>::Shared shapes_;
  const RayKernels& kernels_;
  float margin_;
  std::uint32_t most_rays_;
  std::uint64_t seed_;
  RayPoints points_;
};

}  // namespace shaftcull::kernel
