// SPDX-License-Identifier: MIT
// The pairs of patches, and the rays between them, that visibility is measured with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <vector>

#include "scenes/city_blocks.hpp"
#include "scenes/interior.hpp"
#include "scenes/patch_pairs.hpp"
#include "scenes/shadow_rays.hpp"

namespace shaftcull::bench {
namespace {

const PatchScene& small_interior() {
  static const PatchScene scene = interior({1.5F});
  return scene;
}

bool always(const PatchCluster& /*a*/, const PatchCluster& /*b*/) { return true; }

TEST(Clusters, HoldEveryPatchOnce) {
  const PatchScene& scene = small_interior();
  std::vector<std::uint32_t> all;
  for (const PatchCluster& cluster : clusters_of(scene, 30)) {
    EXPECT_LE(cluster.patches.size(), 30U);
    EXPECT_GT(cluster.patches.size(), 7U);  // halves of more than 30, of rooms of more than 30
    for (const std::uint32_t patch : cluster.patches) {
      EXPECT_EQ(scene.zone[patch], cluster.zone);
      for (std::size_t k = 0; k != 3; ++k) {
        EXPECT_GE(scene.patch_boxes[patch].lo[k], cluster.box.lo[k]);
        EXPECT_LE(scene.patch_boxes[patch].hi[k], cluster.box.hi[k]);
      }
      all.push_back(patch);
    }
  }
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), scene.patches.size());
  for (std::uint32_t i = 0; i != all.size(); ++i) ASSERT_EQ(all[i], i);
}

TEST(Clusters, OfACityMostlyLookOneWay) {
  // No two of their patches look more than a right angle apart.
  const PatchScene scene = city_blocks();
  std::size_t alike = 0;
  const std::vector<PatchCluster> clusters = clusters_of(scene);
  for (const PatchCluster& cluster : clusters) {
    const Vec3& first = scene.patch_planes[cluster.patches[0]].normal;
    alike += std::all_of(cluster.patches.begin(), cluster.patches.end(), [&](std::uint32_t patch) {
      const Vec3& normal = scene.patch_planes[patch].normal;
      return first[0] * normal[0] + first[1] * normal[1] + first[2] * normal[2] >= 0;
    });
  }
  EXPECT_GT(2 * alike, clusters.size());
}

TEST(Distance, IsThatOfTheNearestPoints) {
  EXPECT_EQ(distance({{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}), 0);
  EXPECT_EQ(distance({{0, 0, 0}, {1, 1, 1}}, {{4, 5, 0}, {5, 6, 1}}), 5);
  EXPECT_EQ(distance({{4, 5, 0}, {5, 6, 1}}, {{0, 0, 0}, {1, 1, 1}}), 5);
}

TEST(Products, AreTheSameOfTheSameSeed) {
  const std::vector<PatchCluster> clusters = clusters_of(small_interior());
  const auto first = random_products(clusters, 5, 3, 7, always);
  const auto again = random_products(clusters, 5, 3, 7, always);
  ASSERT_EQ(first.size(), 5U);
  bool differs = false;
  const auto other = random_products(clusters, 5, 3, 8, always);
  for (std::size_t i = 0; i != 5; ++i) {
    EXPECT_EQ(first[i].a, again[i].a);
    EXPECT_EQ(first[i].b, again[i].b);
    differs = differs || first[i].a != other[i].a;
  }
  EXPECT_TRUE(differs);
}

TEST(Products, AreOfDifferentClustersThatMayBePartners) {
  const PatchScene& scene = small_interior();
  const std::vector<PatchCluster> clusters = clusters_of(scene);
  const auto same_room = [](const PatchCluster& a, const PatchCluster& b) { return a.zone == b.zone; };
  for (const PatchProduct& product : random_products(clusters, 20, 4, 9, same_room)) {
    std::set<std::uint32_t> patches(product.a.begin(), product.a.end());
    EXPECT_EQ(patches.size(), product.a.size());
    for (const std::uint32_t patch : product.b) {
      EXPECT_TRUE(patches.insert(patch).second) << "patch " << patch << " is there twice";
      EXPECT_EQ(scene.zone[patch], scene.zone[product.a[0]]);
    }
    EXPECT_FALSE(product.b.empty());
  }
}

TEST(Products, OfClustersThatHaveNoPartnersAreRefused) {
  const auto never = [](const PatchCluster&, const PatchCluster&) { return false; };
  EXPECT_THROW(static_cast<void>(random_products(clusters_of(small_interior()), 1, 1, 1, never)),
               std::invalid_argument);
}

TEST(FacingPairs, AreThoseThatEachLieBeforeTheOther) {
  // A floor, a ceiling above it that looks down, a wall whose foot is below the floor, and a wall behind its back.
  PatchScene scene;
  const auto add = [&scene](const Patch& patch, const Plane& plane) {
    scene.patches.push_back(patch);
    scene.patch_planes.push_back(plane);
  };
  add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, false}, {{0, 0, 1}, 0});
  add({{0, 0, 3}, {0, 1, 0}, {1, 0, 0}, false}, {{0, 0, -1}, -3});
  add({{2, 0, -1}, {0, 0, 2}, {0, 1, 0}, false}, {{-1, 0, 0}, -2});
  add({{3, 0, -1}, {0, 0, 2}, {0, 1, 0}, false}, {{1, 0, 0}, 3});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const FacingPair& pair : facing_pairs(scene, {{0, 2}, {1, 2, 3, 0}})) pairs.emplace_back(pair.a, pair.b);
  EXPECT_THAT(pairs,
              testing::ElementsAre(testing::Pair(0, 1), testing::Pair(0, 2), testing::Pair(2, 1), testing::Pair(2, 0)));
  EXPECT_TRUE(all_in_front(scene.patch_planes[0], scene.patches[1]));
  EXPECT_FALSE(all_in_front(scene.patch_planes[0], scene.patches[2]));
}

TEST(FacingPairs, CountTheCornersOfATriangleOnly) {
  const Patch triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, true};
  Patch rectangle = triangle;
  rectangle.triangle = false;
  const Plane beyond_its_diagonal{{1, 1, 0}, 1.5F};
  EXPECT_FALSE(any_in_front(beyond_its_diagonal, triangle));
  EXPECT_TRUE(any_in_front(beyond_its_diagonal, rectangle));
  const Plane before_its_diagonal{{-1, -1, 0}, -1.5F};
  EXPECT_TRUE(all_in_front(before_its_diagonal, triangle));
  EXPECT_FALSE(all_in_front(before_its_diagonal, rectangle));
}

TEST(ShadowRays, OfEveryCutByHalvingHaveOneInEachBox) {
  for (const unsigned count : {1U, 16U, 64U, 256U}) {
    const ShadowRays rays(count);
    for (const ShadowRays::Points& points : rays.on_rectangle) {
      for (unsigned columns = 1; columns <= count; columns *= 2) {
        const unsigned rows = count / columns;
        std::set<std::pair<unsigned, unsigned>> boxes;
        for (unsigned i = 0; i != count; ++i) {
          const auto column = static_cast<unsigned>(points[0][i] * static_cast<float>(columns));
          const auto row = static_cast<unsigned>(points[1][i] * static_cast<float>(rows));
          boxes.insert({column, row});
        }
        EXPECT_EQ(boxes.size(), count) << columns << " columns";
      }
    }
  }
}

TEST(ShadowRays, OfATriangleAreInside) {
  const ShadowRays rays(64);
  for (const ShadowRays::Points& points : rays.on_triangle) {
    for (unsigned i = 0; i != 64; ++i) {
      EXPECT_GT(points[0][i], 0);
      EXPECT_GT(points[1][i], 0);
      EXPECT_LE(points[0][i] + points[1][i], 1);
    }
  }
}

TEST(ShadowRays, OfBothPatchesAreDealtOutDifferently) {
  const ShadowRays rays(256);
  std::size_t equal = 0;
  for (std::size_t i = 0; i != 256; ++i) equal += rays.on_rectangle[0][0][i] == rays.on_rectangle[1][0][i] ? 1U : 0U;
  EXPECT_LT(equal, 32U);
}

TEST(ShadowRays, ConnectAllPartsOfBothPatches) {
  // A quarter of a patch with a quarter of the other one: 16 of 256 rays each, but for chance.
  const ShadowRays rays(256);
  std::array<unsigned, 16> counts{};
  for (std::size_t i = 0; i != rays.count; ++i) {
    unsigned quarters = 0;
    for (const ShadowRays::Points& points : rays.on_rectangle) {
      for (const std::vector<float>& coordinate : points) quarters = 2 * quarters + (coordinate[i] < 0.5F ? 0 : 1);
    }
    ++counts[quarters];
  }
  for (const unsigned count : counts) {
    EXPECT_GE(count, 7U);
    EXPECT_LE(count, 25U);
  }
}

TEST(ShadowRays, OfAnotherNumberThanAPowerOfTwoAreRefused) {
  EXPECT_THROW(ShadowRays(48), std::invalid_argument);
  EXPECT_THROW(ShadowRays(0), std::invalid_argument);
}

}  // namespace
}  // namespace shaftcull::bench
