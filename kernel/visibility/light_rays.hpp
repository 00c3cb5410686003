// SPDX-License-Identifier: MIT
/// Rays from patches towards lights that are infinitely far away.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "shaftcull/geometry.hpp"
#include "visibility/occluders.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/ray_casting.hpp"
#include "visibility/ray_shapes.hpp"

namespace shaftcull::kernel {

/// Casts rays; many threads may do so at once. It refers to what it is given.
class LightRays {
 public:
  /// As SightRays.
  LightRays(const PatchTree& patches, const OccluderData& occluders, float tolerance, std::uint32_t most_rays,
            std::uint64_t seed);

  /// Whether a patch, by its index, sees on the side that a light is on; `light` is a unit vector towards it.
  [[nodiscard]] bool faces(std::uint32_t patch, const Vec3& light) const noexcept;

  /// Casts rays from a patch, as cast_rays() does. The light's number is one part of what rays depend on.
  template <class IsEnough>
  [[nodiscard]] RayTally cast(std::uint32_t patch, const Vec3& light, std::uint32_t number,
                              std::span<const std::uint32_t> candidates, const IsEnough& is_enough) const {
    const RayShift shift(seed_, {patch, number});
    const auto cast_some = [&](RayTally& tally, std::uint32_t count) {
      cast_packet(patch, light, shift, candidates, count, tally);
    };
    return cast_rays(most_rays_, most_rays_, cast_some, is_enough);
  }

 private:
  void cast_packet(std::uint32_t patch, const Vec3& light, const RayShift& shift,
                   std::span<const std::uint32_t> candidates, std::uint32_t count, RayTally& tally) const;

  std::shared_ptr<const RayPatches> patches_;
  RayTargets targets_;
  std::uint32_t most_rays_;
  std::uint64_t seed_;
  RayPoints points_;
};

}  // namespace shaftcull::kernel
