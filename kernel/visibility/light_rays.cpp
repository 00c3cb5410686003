// SPDX-License-Identifier: MIT
#include "visibility/light_rays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

LightRays::LightRays(const PatchTree& patches, const OccluderData& occluders, float tolerance, std::uint32_t most_rays,
                     std::uint64_t seed)
    : patches_(patches.ray_patches()),
      targets_(occluders, patches_->around, patches.largest_coordinate(), tolerance),
      most_rays_((most_rays + 15) / 16 * 16),
      seed_(seed),
      points_(most_rays_, 2) {}

bool LightRays::faces(std::uint32_t patch, const Vec3& light) const noexcept {
  const RayPatch& of = patches_->patches[patch];
  const float rise = of.normal[0] * light[0] + of.normal[1] * light[1] + of.normal[2] * light[2];
  return rise > of.least_rise && rise != 0;  // 0 of what has no area, too
}

void LightRays::cast_packet(std::uint32_t patch, const Vec3& light, const RayShift& shift,
                            std::span<const std::uint32_t> candidates, std::uint32_t count, RayTally& tally) const {
  // From each point of the patch to the same point of the patch moved beyond everything: so rays are parallel. At the
  // origin, moving it rounds nothing away.
  RayPatch here = patches_->patches[patch];
  std::fill(std::begin(here.corner), std::end(here.corner), 0.0F);
  RayPatch there = here;
  for (std::size_t k = 0; k != 3; ++k) there.corner[k] = light[k] * targets_.reach();
  there.least_rise = -HUGE_VALF;
  const float* const points[4]{points_.stream(0) + tally.rays, points_.stream(1) + tally.rays,
                               points_.stream(0) + tally.rays, points_.stream(1) + tally.rays};
  const float moved[4]{shift.of[0], shift.of[1], shift.of[0], shift.of[1]};
  RayPacket packet;
  const std::uint64_t facing = targets_.kernels().form(here, there, points, moved, count, packet);
  std::copy(std::begin(patches_->patches[patch].corner), std::end(patches_->patches[patch].corner),
            std::begin(packet.origin));
  tally.add(count, facing, targets_.unmet(packet, candidates, facing));
}

}  // namespace shaftcull::kernel
