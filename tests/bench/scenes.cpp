// SPDX-License-Identifier: MIT
// The scenes of patches that visibility is measured on are what bench/scenes says of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/city_blocks.hpp"
#include "scenes/interior.hpp"

namespace shaftcull::bench {
namespace {

struct NamedScene {
  std::string name;
  PatchScene scene;
  float edge;
};

const NamedScene& scene_of(bool city) {
  static const NamedScene inside{"interior", interior(), interior_patch};
  static const NamedScene outside{"city", city_blocks(), city_blocks_patch};
  return city ? outside : inside;
}

class Scene : public testing::TestWithParam<bool> {
 protected:
  const PatchScene& scene = scene_of(GetParam()).scene;
  const float edge = scene_of(GetParam()).edge;
};

INSTANTIATE_TEST_SUITE_P(Of, Scene, testing::Bool(), [](const auto& which) { return scene_of(which.param).name; });

double along(const Plane& plane, const Vec3& p) {
  double sum = 0;
  for (std::size_t k = 0; k != 3; ++k) sum += static_cast<double>(plane.normal[k]) * static_cast<double>(p[k]);
  return sum;
}

Vec3 point(const Patch& patch, float u, float v) {
  Vec3 p = patch.corner;
  for (std::size_t k = 0; k != 3; ++k) p[k] += u * patch.across[k] + v * patch.up[k];
  return p;
}

std::vector<Vec3> corners_of(const Patch& patch) {
  std::vector<Vec3> corners{patch.corner, point(patch, 1, 0), point(patch, 0, 1)};
  if (!patch.triangle) corners.push_back(point(patch, 1, 1));
  return corners;
}

std::span<const Triangle> triangles_of(const PatchScene& scene, std::size_t object) {
  return std::span(scene.triangles).subspan(scene.objects[object], scene.objects[object + 1] - scene.objects[object]);
}

/// FNV-1a.
class Hash {
 public:
  void add(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    for (unsigned i = 0; i != 32; i += 8) value_ = (value_ ^ (bits >> i & 255U)) * 0x100000001b3U;
  }
  void add(const Vec3& p) {
    for (const float x : p) add(x);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

std::uint64_t hash_of(const PatchScene& scene) {
  Hash hash;
  for (const Triangle& triangle : scene.triangles) {
    for (const Vec3& vertex : triangle.vertex) hash.add(vertex);
  }
  for (const Patch& patch : scene.patches) {
    hash.add(patch.corner);
    hash.add(patch.across);
    hash.add(patch.up);
  }
  for (const Plane& plane : scene.patch_planes) {
    hash.add(plane.normal);
    hash.add(plane.offset);
  }
  return hash.value();
}

/// Whether p is inside of the solid that has these triangles, each seen from outside counterclockwise.
bool is_inside(std::span<const Triangle> solid, const Vec3& p) {
  return std::all_of(solid.begin(), solid.end(), [&p](const Triangle& t) {
    std::array<double, 3> u{};
    std::array<double, 3> v{};
    std::array<double, 3> w{};
    for (std::size_t k = 0; k != 3; ++k) {
      const auto origin = static_cast<double>(t.vertex[0][k]);
      u[k] = static_cast<double>(t.vertex[1][k]) - origin;
      v[k] = static_cast<double>(t.vertex[2][k]) - origin;
      w[k] = static_cast<double>(p[k]) - origin;
    }
    return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
               (u[0] * v[1] - u[1] * v[0]) * w[2] <
           0;
  });
}

TEST(Interior, IsAsLargeAsItSays) {
  const PatchScene& scene = scene_of(false).scene;
  EXPECT_EQ(scene.triangles.size(), 250'260U);
  EXPECT_EQ(scene.patches.size(), 26'256U);
  EXPECT_EQ(scene.boxes.size(), 87U);
  EXPECT_EQ(scene.turned.size(), 288U);
  EXPECT_EQ(scene.objects.size() - 1 - scene.first_mesh(), 48U);
  EXPECT_THAT(std::set(scene.zone.begin(), scene.zone.end()), testing::SizeIs(16));
}

TEST(CityBlocks, IsAsLargeAsItSays) {
  const PatchScene& scene = scene_of(true).scene;
  EXPECT_EQ(scene.triangles.size(), 12U * 10'001);
  EXPECT_EQ(scene.patches.size(), 13'482U);
  EXPECT_EQ(scene.boxes.size() + scene.turned.size(), 10'001U);
  EXPECT_EQ(scene.turned.size(), 3'380U);
  EXPECT_EQ(scene.objects.size() - 1, scene.first_mesh());
}

TEST(Interior, IsTheSameByEveryCompiler) { EXPECT_EQ(hash_of(scene_of(false).scene), 16782157777638821154U); }

TEST(CityBlocks, IsTheSameByEveryCompiler) { EXPECT_EQ(hash_of(scene_of(true).scene), 2124378406928901268U); }

TEST(Interior, OfAnotherSeedIsAnother) {
  EXPECT_NE(hash_of(interior({interior_patch}, 5001)), hash_of(scene_of(false).scene));
}

TEST(CityBlocks, OfAnotherSeedIsAnother) {
  EXPECT_NE(hash_of(city_blocks({city_blocks_patch}, 5101)), hash_of(scene_of(true).scene));
}

TEST_P(Scene, TwiceAsFineHasFourTimesThePatchesAndTheSameSurfaces) {
  const PatchSize finer{edge, 2};
  const PatchScene fine = GetParam() ? city_blocks(finer) : interior(finer);
  EXPECT_EQ(fine.patches.size(), 4 * scene.patches.size());
  EXPECT_EQ(fine.triangles, scene.triangles);
}

TEST_P(Scene, ObjectsAreAllTriangles) {
  EXPECT_EQ(scene.objects.front(), 0U);
  EXPECT_EQ(scene.objects.back(), scene.triangles.size());
  EXPECT_TRUE(std::is_sorted(scene.objects.begin(), scene.objects.end()));
}

TEST_P(Scene, PatchesAreFiniteAndHaveArea) {
  ASSERT_EQ(scene.patch_boxes.size(), scene.patches.size());
  ASSERT_EQ(scene.patch_planes.size(), scene.patches.size());
  ASSERT_EQ(scene.zone.size(), scene.patches.size());
  for (const Patch& patch : scene.patches) {
    for (const Vec3& corner : corners_of(patch)) {
      for (const float x : corner) ASSERT_TRUE(std::isfinite(x));
    }
    for (const Vec3& edge_of_patch : {patch.across, patch.up}) {
      ASSERT_GT(std::hypot(edge_of_patch[0], edge_of_patch[1], edge_of_patch[2]), 0.01F);
    }
  }
}

TEST_P(Scene, PatchesAreInTheirBoxes) {
  for (std::size_t i = 0; i != scene.patches.size(); ++i) {
    for (const Vec3& corner : corners_of(scene.patches[i])) {
      for (std::size_t k = 0; k != 3; ++k) {
        const float rounding = 1e-6F * std::max(std::abs(corner[k]), 1.0F);
        ASSERT_GE(corner[k], scene.patch_boxes[i].lo[k] - rounding);
        ASSERT_LE(corner[k], scene.patch_boxes[i].hi[k] + rounding);
      }
    }
  }
}

TEST_P(Scene, PatchesLieOnTheirPlanesButNotBeforeThem) {
  for (std::size_t i = 0; i != scene.patches.size(); ++i) {
    const Plane& plane = scene.patch_planes[i];
    ASSERT_NEAR(std::hypot(plane.normal[0], plane.normal[1], plane.normal[2]), 1, 1e-6);
    for (const Vec3& corner : corners_of(scene.patches[i])) {
      const double scale = std::max({1.0F, std::abs(corner[0]), std::abs(corner[1]), std::abs(corner[2])});
      ASSERT_NEAR(along(plane, corner), static_cast<double>(plane.offset), 1e-6 * scale);
    }
    // Corners as they were before they were taken apart: two of them are those of the box.
    ASSERT_LE(along(plane, scene.patches[i].corner), static_cast<double>(plane.offset));
  }
}

TEST_P(Scene, BoxesAndTurnedBoxesAreTheirTriangles) {
  for (std::size_t object = 0; object != scene.first_mesh(); ++object) {
    std::set<Vec3> vertices;
    std::multiset<std::pair<Vec3, Vec3>> edges;
    for (const Triangle& triangle : triangles_of(scene, object)) {
      for (std::size_t i = 0; i != 3; ++i) {
        vertices.insert(triangle.vertex[i]);
        edges.insert({triangle.vertex[i], triangle.vertex[(i + 1) % 3]});
      }
    }
    std::set<Vec3> corners;
    if (object < scene.boxes.size()) {
      const Box& box = scene.boxes[object];
      for (unsigned i = 0; i != 8; ++i) {
        corners.insert({(i & 1U) != 0 ? box.lo[0] : box.hi[0], (i & 2U) != 0 ? box.lo[1] : box.hi[1],
                        (i & 4U) != 0 ? box.lo[2] : box.hi[2]});
      }
    } else {
      const TurnedBox& box = scene.turned[object - scene.boxes.size()];
      corners.insert(box.begin(), box.end());
    }
    ASSERT_EQ(vertices, corners) << "object " << object;
    ASSERT_EQ(triangles_of(scene, object).size(), 12U);
    for (const auto& [from, to] : edges) ASSERT_EQ(edges.count({to, from}), 1U) << "object " << object << " is open";
    Vec3 middle{};
    for (const Vec3& corner : corners) {
      for (std::size_t k = 0; k != 3; ++k) middle[k] += corner[k] / 8;
    }
    ASSERT_TRUE(is_inside(triangles_of(scene, object), middle)) << "object " << object << " is inside out";
  }
}

TEST_P(Scene, SolidsAreApart) {
  // The middle of no solid is in another one.
  std::vector<Vec3> middles;
  for (std::size_t object = 0; object != scene.first_mesh(); ++object) {
    Vec3 middle{};
    for (const Triangle& triangle : triangles_of(scene, object)) {
      for (const Vec3& vertex : triangle.vertex) {
        for (std::size_t k = 0; k != 3; ++k) middle[k] += vertex[k] / 36;
      }
    }
    middles.push_back(middle);
  }
  for (std::size_t i = 0; i < middles.size(); i += GetParam() ? 37 : 1) {
    for (std::size_t object = 0; object != scene.first_mesh(); ++object) {
      ASSERT_EQ(is_inside(triangles_of(scene, object), middles[i]), object == i) << i << " and " << object;
    }
  }
}

TEST_P(Scene, RectanglesAreOnSolidsAndLookAway) {
  std::size_t rectangles = 0;
  std::size_t covered = 0;
  const float step = GetParam() ? 0.05F : 0.001F;
  for (std::size_t i = 0; i < scene.patches.size(); i += GetParam() ? 37 : 1) {
    if (scene.patches[i].triangle) continue;
    ++rectangles;
    Vec3 before = point(scene.patches[i], 0.5F, 0.5F);
    Vec3 behind = before;
    for (std::size_t k = 0; k != 3; ++k) {
      before[k] += step * scene.patch_planes[i].normal[k];
      behind[k] -= step * scene.patch_planes[i].normal[k];
    }
    bool on_solid = false;
    bool is_covered = false;
    for (std::size_t object = 0; object != scene.first_mesh(); ++object) {
      on_solid = on_solid || is_inside(triangles_of(scene, object), behind);
      is_covered = is_covered || is_inside(triangles_of(scene, object), before);
    }
    ASSERT_TRUE(on_solid) << "patch " << i;
    covered += is_covered ? 1 : 0;
  }
  EXPECT_LT(covered, rectangles / 20);  // the floor below furniture
}

TEST(Interior, SpheresAreBehindAllPatchesAroundThem) {
  const PatchScene& scene = scene_of(false).scene;
  std::size_t patch = 0;
  for (std::size_t object = scene.first_mesh(); object + 1 != scene.objects.size(); ++object) {
    const std::span<const Triangle> sphere = triangles_of(scene, object);
    ASSERT_EQ(sphere.size(), 5120U);
    Vec3 centre{};
    for (const Triangle& triangle : sphere) {
      for (std::size_t k = 0; k != 3; ++k) centre[k] += triangle.vertex[0][k] / 5120;
    }
    std::size_t around = 0;
    for (; patch != scene.patches.size(); ++patch) {
      if (!scene.patches[patch].triangle) {
        if (around != 0) break;
        continue;
      }
      const Vec3 middle = point(scene.patches[patch], 0.33F, 0.33F);
      if (std::hypot(middle[0] - centre[0], middle[1] - centre[1], middle[2] - centre[2]) > 0.5F) break;
      ++around;
      const Plane& plane = scene.patch_planes[patch];
      for (const Triangle& triangle : sphere) {
        ASSERT_LT(along(plane, triangle.vertex[0]), static_cast<double>(plane.offset)) << "patch " << patch;
      }
    }
    EXPECT_EQ(around, 80U) << "object " << object;
  }
  for (; patch != scene.patches.size(); ++patch) ASSERT_FALSE(scene.patches[patch].triangle);
}

TEST(Interior, EverythingIsInTheBuilding) {
  for (const Triangle& triangle : scene_of(false).scene.triangles) {
    for (const Vec3& vertex : triangle.vertex) {
      for (std::size_t k = 0; k != 2; ++k) {
        ASSERT_GE(vertex[k], 0);
        ASSERT_LE(vertex[k], 25.01F);
      }
    }
  }
}

}  // namespace
}  // namespace shaftcull::bench
