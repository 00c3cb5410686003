// SPDX-License-Identifier: MIT
#include "patch_rays.hpp"

#include <cmath>
#include <cstddef>

namespace shaftcull::cli {
namespace {

/// Patches as the triangles that they are; for comparing, some are rectangles around them (patch_outlines.hpp).
PatchSet triangles_of(const SeesScene& scene) {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (const MeshPatch& patch : scene.patches) {
    for (const Point3& corner : patch.corner) {
      corners.push_back({static_cast<float>(corner[0]), static_cast<float>(corner[1]), static_cast<float>(corner[2])});
    }
    first.push_back(corners.size());
  }
  return PatchSet(corners, first, scene.planes.empty() ? PatchSides::both : PatchSides::front);
}

}  // namespace

PatchRays::PatchRays(const SeesScene& scene, std::uint32_t rays, std::uint64_t seed)
    : scene_(scene),
      patches_(triangles_of(scene)),
      options_{.rays = rays, .error = 0, .seed = seed, .tolerance = scene.tolerance} {}

void PatchRays::count_seen(const UndecidedPairs& undecided, std::span<std::uint32_t> seen) const {
  std::vector<float> fractions(seen.size());
  visible_fractions(patches_, patches_, scene_.occluders, undecided, fractions, options_);
  for (std::size_t i = 0; i != seen.size(); ++i) {
    seen[i] = static_cast<std::uint32_t>(std::lround(static_cast<double>(fractions[i]) * options_.rays));
  }
}

}  // namespace shaftcull::cli
