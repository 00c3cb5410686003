// SPDX-License-Identifier: MIT
/// Rays between patches of a scene, for pairs of which shafts cannot tell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sees_scene.hpp"
#include "shaftcull/rays.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::cli {

/// Const members are safe to call from many threads. It refers to the scene.
class PatchRays {
 public:
  /// So many rays of each pair; their points depend on `seed` and the pair alone.
  PatchRays(const SeesScene& scene, std::uint32_t rays, std::uint64_t seed);

  /// Writes how many of the rays of each pair meet no candidate.
  void count_seen(const UndecidedPairs& undecided, std::span<std::uint32_t> seen) const;

 private:
  const SeesScene& scene_;
  PatchSet patches_;  ///< with the outlines that they have in the mesh
  RayOptions options_;
};

}  // namespace shaftcull::cli
