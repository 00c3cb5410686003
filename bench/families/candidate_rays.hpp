// SPDX-License-Identifier: MIT
/// Shadow rays against the few occluders that visibility() leaves for a pair.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/patch_pairs.hpp"
#include "scenes/patch_scene.hpp"
#include "scenes/shadow_rays.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::bench {

/// An occluder as rays are tested with it: a box in a frame that is turned about the vertical.
struct RayBox {
  float cosine;
  float sine;  ///< 0 if it is not turned
  Vec3 centre;
  Vec3 half;
  bool solid;
};

/// A scene's objects, in their order, which is that of the occluders that are made of them.
[[nodiscard]] std::vector<RayBox> ray_boxes_of(const PatchScene& scene);

/// Patches of a pair, with their planes.
struct RayEnds {
  const Patch& a;
  const Patch& b;
  const Plane& plane_a;
  const Plane& plane_b;
};

/// What became of a pair's rays.
struct CandidateCounts {
  unsigned traced;  ///< neither leave nor arrive behind a patch
  unsigned clear;   ///< of these, meet no box
  unsigned maybe;   ///< meet no solid box, but boxes around meshes
};

/// Tests the rays, a multiple of 16, with those boxes whose numbers are in `candidates`, and writes for each ray
/// whether it is one of those that may be clear.
using TraceCandidates = CandidateCounts(const RayEnds& ends, const ShadowRays& rays, std::span<const RayBox> boxes,
                                        std::span<const std::uint32_t> candidates, std::uint64_t* maybe) noexcept;

/// As it is compiled for `isa`, or null: for avx2 and avx512 alone, where this build has them.
[[nodiscard]] TraceCandidates* trace_candidates(Isa isa) noexcept;

}  // namespace shaftcull::bench
