// SPDX-License-Identifier: MIT
#include "scenes/patch_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "scenes/random.hpp"

namespace shaftcull::bench {
namespace {

using Features = std::array<float, 6>;  // where a patch is, and which way it looks

Features features_of(const PatchScene& scene, std::uint32_t patch, float weight) {
  const Box& box = scene.patch_boxes[patch];
  const Vec3& normal = scene.patch_planes[patch].normal;
  Features features{};
  for (std::size_t k = 0; k != 3; ++k) {
    features[k] = 0.5F * (box.lo[k] + box.hi[k]);
    features[3 + k] = weight * normal[k];
  }
  return features;
}

Box joined_boxes(const PatchScene& scene, std::span<const std::uint32_t> patches) {
  Box box = scene.patch_boxes[patches[0]];
  for (const std::uint32_t patch : patches) {
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = std::min(box.lo[k], scene.patch_boxes[patch].lo[k]);
      box.hi[k] = std::max(box.hi[k], scene.patch_boxes[patch].hi[k]);
    }
  }
  return box;
}

void split(const PatchScene& scene, std::span<std::uint32_t> patches, std::size_t most, float weight,
           std::vector<PatchCluster>& clusters) {
  if (patches.size() <= most) {
    clusters.push_back({{patches.begin(), patches.end()}, joined_boxes(scene, patches), scene.zone[patches.front()]});
    return;
  }
  Features least = features_of(scene, patches[0], weight);
  Features greatest = least;
  for (const std::uint32_t patch : patches) {
    const Features features = features_of(scene, patch, weight);
    for (std::size_t k = 0; k != 6; ++k) {
      least[k] = std::min(least[k], features[k]);
      greatest[k] = std::max(greatest[k], features[k]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k != 6; ++k) {
    if (greatest[k] - least[k] > greatest[axis] - least[axis]) axis = k;
  }
  std::sort(patches.begin(), patches.end(), [&](std::uint32_t p, std::uint32_t q) {
    const float of_p = features_of(scene, p, weight)[axis];
    const float of_q = features_of(scene, q, weight)[axis];
    return of_p != of_q ? of_p < of_q : p < q;
  });
  const std::size_t half = patches.size() / 2;
  split(scene, patches.first(half), most, weight, clusters);
  split(scene, patches.subspan(half), most, weight, clusters);
}

double height_above(const Plane& plane, const Vec3& p) {
  double sum = -static_cast<double>(plane.offset);
  for (std::size_t k = 0; k != 3; ++k) sum += static_cast<double>(plane.normal[k]) * static_cast<double>(p[k]);
  return sum;
}

/// How many corners are higher above the plane than `height`, and how many there are.
std::array<unsigned, 2> corners_above(const Plane& plane, double height, const Patch& patch) {
  const auto is_in_front = [&](float u, float v) -> unsigned {
    Vec3 p = patch.corner;
    for (std::size_t k = 0; k != 3; ++k) p[k] += u * patch.across[k] + v * patch.up[k];
    return height_above(plane, p) > height ? 1 : 0;
  };
  const unsigned three = is_in_front(0, 0) + is_in_front(1, 0) + is_in_front(0, 1);
  if (patch.triangle) return {three, 3};
  return {three + is_in_front(1, 1), 4};
}

}  // namespace

std::vector<PatchCluster> clusters_of(const PatchScene& scene, std::size_t most) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> zones;
  for (std::uint32_t i = 0; i != scene.patches.size(); ++i) zones[scene.zone[i]].push_back(i);
  std::vector<PatchCluster> clusters;
  for (auto& [zone, patches] : zones) {
    const Box box = joined_boxes(scene, patches);
    float longest = 0;
    for (std::size_t k = 0; k != 3; ++k) longest = std::max(longest, box.hi[k] - box.lo[k]);
    split(scene, patches, most, longest / 2, clusters);
  }
  return clusters;
}

float distance(const Box& a, const Box& b) {
  float squares = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const float gap = std::max({a.lo[k] - b.hi[k], b.lo[k] - a.hi[k], 0.0F});
    squares += gap * gap;
  }
  return std::sqrt(squares);
}

std::vector<PatchProduct> random_products(
    const std::vector<PatchCluster>& clusters, std::size_t count, std::size_t others, std::uint32_t seed,
    const std::function<bool(const PatchCluster&, const PatchCluster&)>& may_be_partners) {
  Random random(seed);
  std::vector<PatchProduct> products;
  std::size_t passed_over = 0;
  while (products.size() != count) {
    const std::size_t chosen = random.below(static_cast<unsigned>(clusters.size()));
    std::vector<std::size_t> partners;
    for (std::size_t i = 0; i != clusters.size(); ++i) {
      if (i != chosen && may_be_partners(clusters[chosen], clusters[i])) partners.push_back(i);
    }
    if (partners.empty()) {
      if (++passed_over > 100 * clusters.size()) throw std::invalid_argument("no cluster has partners");
      continue;
    }
    PatchProduct product{clusters[chosen].patches, {}};
    for (std::size_t n = 0; n != others && !partners.empty(); ++n) {
      const std::size_t at = random.below(static_cast<unsigned>(partners.size()));
      const std::vector<std::uint32_t>& of_partner = clusters[partners[at]].patches;
      product.b.insert(product.b.end(), of_partner.begin(), of_partner.end());
      partners.erase(partners.begin() + static_cast<std::ptrdiff_t>(at));
    }
    products.push_back(product);
  }
  return products;
}

bool any_in_front(const Plane& plane, const Patch& patch) {
  const double rounding = 1e-6 * std::max(1.0, std::abs(static_cast<double>(plane.offset)));
  return corners_above(plane, rounding, patch)[0] != 0;
}

bool all_in_front(const Plane& plane, const Patch& patch) {
  const auto [in_front, corners] = corners_above(plane, 0, patch);
  return in_front == corners;
}

std::vector<FacingPair> facing_pairs(const PatchScene& scene, const PatchProduct& product) {
  std::vector<FacingPair> pairs;
  for (const std::uint32_t a : product.a) {
    for (const std::uint32_t b : product.b) {
      if (any_in_front(scene.patch_planes[a], scene.patches[b]) &&
          any_in_front(scene.patch_planes[b], scene.patches[a])) {
        pairs.push_back({a, b});
      }
    }
  }
  return pairs;
}

}  // namespace shaftcull::bench
