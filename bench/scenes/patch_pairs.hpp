// SPDX-License-Identifier: MIT
/// Pairs of patches that are asked whether they see each other, by clusters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scenes/patch_scene.hpp"

namespace shaftcull::bench {

/// Neighbouring patches of one zone that look about the same way.
struct PatchCluster {
  std::vector<std::uint32_t> patches;
  Box box;
  std::uint32_t zone;
};

/// All patches in clusters of at most `most`, by halving along the longest of the extents of their middles and, weighed
/// by half the size of the zone, of their normals.
[[nodiscard]] std::vector<PatchCluster> clusters_of(const PatchScene& scene, std::size_t most = 64);

/// The distance between two boxes; 0 if they touch.
[[nodiscard]] float distance(const Box& a, const Box& b);

/// All of the one cluster with all of some others.
struct PatchProduct {
  std::vector<std::uint32_t> a;
  std::vector<std::uint32_t> b;
};

/// Products of random clusters, each with up to `others` different ones that may be its partners. No cluster is its own
/// partner. Clusters without partners are passed over; there must be one that has some.
[[nodiscard]] std::vector<PatchProduct> random_products(
    const std::vector<PatchCluster>& clusters, std::size_t count, std::size_t others, std::uint32_t seed,
    const std::function<bool(const PatchCluster&, const PatchCluster&)>& may_be_partners);

/// Whether any corner of the patch is in front of the plane, by more than what rounding moves corners of flat surfaces.
[[nodiscard]] bool any_in_front(const Plane& plane, const Patch& patch);
/// Whether all corners are.
[[nodiscard]] bool all_in_front(const Plane& plane, const Patch& patch);

/// Two patches, each with a corner in front of the other's plane.
struct FacingPair {
  std::uint32_t a;
  std::uint32_t b;
};

/// Those of a product, row by row.
[[nodiscard]] std::vector<FacingPair> facing_pairs(const PatchScene& scene, const PatchProduct& product);

}  // namespace shaftcull::bench
