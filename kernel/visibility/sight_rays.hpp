// SPDX-License-Identifier: MIT
/// Rays between two patches against their candidates.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "shaftcull/visibility.hpp"
#include "visibility/occluders.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/ray_casting.hpp"
#include "visibility/ray_shapes.hpp"

namespace shaftcull::kernel {

/// Sums of RayPacket::weight of the rays of a pair. Their order is the same everywhere, and so are their bits.
struct RayWeights {
  double all = 0;
  double of_seen = 0;
  double squares = 0;
  double squares_of_seen = 0;

  void add(const RayPacket& packet, std::uint64_t unmet) noexcept;
};

/// How well rays with some weights show which part of all weight arrives, whatever they meet.
struct RayPrecision {
  double inverse_of_count;  ///< 1 by the number of rays; where few have most of the weight, only they count
  double lack;              ///< the error for weight that no ray has, which is known only as well as by so many rays

  /// Given the mean weight of all rays that there might be, those that leave or arrive behind included.
  RayPrecision(const RayTally& tally, const RayWeights& weights, double mean_weight) noexcept;

  /// The standard error to expect if about half arrives. Points fill patches evenly, so it is half of what it would be
  /// for independent rays. Rays that are cast until this is small enough are as many whatever they meet: if what they
  /// met decided, few would be cast where none of the first arrives by chance, and sums over many pairs would be too
  /// small.
  [[nodiscard]] double expected_error() const noexcept;
};

/// Which part of the weight arrives, and the standard error of that.
struct SeenShare {
  double part;
  double error;

  /// Weights of the rays that were cast differ from the mean by chance, and what arrives differs with them: so much of
  /// it is taken back.
  /// Where patches touch, few rays have most of the weight, and this makes the error several times smaller. (A
  /// regression estimator: W. G. Cochran, "Sampling Techniques", 1977.)
  SeenShare(const RayTally& tally, const RayWeights& weights, double mean_weight) noexcept;
};

/// Casts rays; many threads may do so at once. It refers to what it is given.
class SightRays {
 public:
  /// Rays of a pair depend on `seed` and the pair alone. What is nearer than `tolerance` to an end of a ray is what the
  /// end lies on.
  SightRays(const PatchTree& a, const PatchTree& b, const OccluderData& occluders, float tolerance,
            std::uint32_t most_rays, std::uint64_t seed);

  /// Casts rays between two patches, by their indices, against these candidates, as cast_rays() does. Adds up their
  /// weights, unless `weights` is null.
  template <class IsEnough>
  [[nodiscard]] RayTally cast(PatchPair pair, std::span<const std::uint32_t> candidates, std::uint32_t rays,
                              RayWeights* weights, const IsEnough& is_enough) const {
    const RayShift shift(seed_, pair);
    return cast_rays(
        rays, most_rays_,
        [&](RayTally& tally, std::uint32_t count) { cast_packet(pair, shift, candidates, count, tally, weights); },
        is_enough);
  }

 private:
  void cast_packet(PatchPair pair, const RayShift& shift, std::span<const std::uint32_t> candidates,
                   std::uint32_t count, RayTally& tally, RayWeights* weights) const;

  std::shared_ptr<const RayPatches> a_;
  std::shared_ptr<const RayPatches> b_;
  RayTargets targets_;
  std::uint32_t most_rays_;
  std::uint64_t seed_;
  RayPoints points_;
};

}  // namespace shaftcull::kernel
