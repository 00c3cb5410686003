// SPDX-License-Identifier: MIT
/// Rays through large groups of triangles: they meet what they meet of the triangles one by one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"
#include "visibility/fractions.hpp"

namespace shaftcull {
namespace {

enum class Mesh : std::uint8_t { sheet, soup, slivers, flat, repeated, clusters };
constexpr std::array<Mesh, 6> meshes{Mesh::sheet, Mesh::soup,     Mesh::slivers,
                                     Mesh::flat,  Mesh::repeated, Mesh::clusters};

/// A triangle in the cube from 0 to 1.
Triangle triangle_in(Mesh mesh, Random& random) {
  const auto near = [&](const Vec3& at, float size) {
    Triangle triangle{{at, at, at}};
    for (Vec3& vertex : triangle.vertex) {
      for (float& x : vertex) x += random.uniform(-size, size);
    }
    return triangle;
  };
  const Vec3 anywhere = random.vec3(0, 1);
  switch (mesh) {
    case Mesh::sheet: {  // tilted squares of a grid, with gaps
      const float x = random.integer(0, 24) / 25;
      const float y = random.integer(0, 24) / 25;
      const auto at = [](float u, float v) { return Vec3{u, v, 0.5F + 0.1F * (u - v)}; };
      return random.one_in(2) ? Triangle{{at(x, y), at(x + 0.04F, y), at(x, y + 0.04F)}}
                              : Triangle{{at(x + 0.04F, y), at(x + 0.04F, y + 0.04F), at(x, y + 0.04F)}};
    }
    case Mesh::soup:
      return near(anywhere, std::ldexp(1.0F, -static_cast<int>(random.below(10))));
    case Mesh::slivers: {
      Triangle triangle = near(anywhere, 0.001F);
      for (std::size_t k = 0; k != 3; ++k) triangle.vertex[2][k] = random.uniform(0, 1);
      return triangle;
    }
    case Mesh::flat: {
      Triangle triangle = near(anywhere, 0.03F);
      for (Vec3& vertex : triangle.vertex) vertex[2] = 0.5F;
      return triangle;
    }
    case Mesh::repeated:  // some without an area
      return {{Vec3{0.3F, 0.2F, 0.4F}, {random.one_in(3) ? 0.8F : 0.3F, 0.2F, 0.6F}, {0.4F, 0.8F, 0.5F}}};
    case Mesh::clusters:
      return near(random.one_in(50) ? anywhere : Vec3{0.5F, 0.5F, 0.5F}, random.one_in(50) ? 0.2F : 0.005F);
  }
  return {};
}

/// A rectangle in a plane through the cube, or beside it.
void add_patch(Random& random, float scale, const Vec3& moved, std::vector<Vec3>& corners) {
  const std::size_t axis = random.below(3);
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  Vec3 corner = random.vec3(0, 1);
  if (!random.one_in(4)) corner[axis] = random.one_in(2) ? -0.5F : 1.5F;
  const float size = std::ldexp(random.uniform(0.5F, 1), -static_cast<int>(random.below(8)));
  for (const std::array<float, 2> at : {std::array<float, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    Vec3 point = corner;
    point[u] += size * at[0];
    point[v] += size * at[1];
    for (std::size_t k = 0; k != 3; ++k) point[k] = point[k] * scale + moved[k];
    corners.push_back(point);
  }
}

struct GroupScene {
  static constexpr std::uint32_t count = 6;  ///< of patches
  float scale = 1;
  std::vector<Triangle> triangles;
  PatchSet patches;
  std::vector<PatchPair> pairs;

  GroupScene(Mesh mesh, std::uint64_t seed) {
    Random random(seed);
    if (random.one_in(3)) scale = std::ldexp(1.0F, static_cast<int>(random.integer(-110, 100)));
    Vec3 moved{};
    if (random.one_in(3)) moved = random.vec3(-100 * scale, 100 * scale);
    const unsigned most = 513 + random.below(1500);
    for (unsigned i = 0; i != most; ++i) {
      Triangle& triangle = triangles.emplace_back(triangle_in(mesh, random));
      for (Vec3& vertex : triangle.vertex) {
        for (std::size_t k = 0; k != 3; ++k) vertex[k] = vertex[k] * scale + moved[k];
      }
    }
    std::vector<Vec3> corners;
    std::vector<std::size_t> first{0};
    for (std::uint32_t i = 0; i != count; ++i) {
      add_patch(random, scale, moved, corners);
      first.push_back(corners.size());
    }
    patches = PatchSet(corners, first, PatchSides::both);
    for (std::uint32_t i = 0; i != count; ++i) {
      for (std::uint32_t j = 0; j != i; ++j) pairs.push_back({i, j});
    }
  }

  /// In groups of so many.
  [[nodiscard]] Occluders in_groups_of(std::size_t size) const {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < triangles.size(); i += size) first.push_back(i);
    first.push_back(triangles.size());
    Occluders occluders;
    occluders.add_triangles(TriangleStream(std::span<const Triangle>(triangles)), first);
    return occluders;
  }
};

TEST(RayTrees, LetThroughWhatTrianglesOneByOneDo) {
  std::size_t partly = 0;
  for (std::uint64_t seed = 0; seed != random_cases(12); ++seed) {
    for (const Mesh mesh : meshes) {
      SCOPED_TRACE(testing::Message() << "mesh " << static_cast<unsigned>(mesh) << ", seed " << seed);
      const GroupScene scene(mesh, seed);
      const Occluders one_by_one = scene.in_groups_of(1);
      const Occluders all = scene.in_groups_of(scene.triangles.size());
      // With a tolerance, boxes around triangles are larger, too.
      for (const RayOptions& options : {RayOptions{.rays = 16}, RayOptions{.rays = 128},
                                        RayOptions{.rays = 128, .tolerance = 0.02F * scene.scale}}) {
        const std::vector<float> right = fractions_of(scene.patches, scene.patches, one_by_one, scene.pairs, options);
        for (const float fraction : right) partly += fraction > 0 && fraction < 1 ? 1 : 0;
        on_each_instruction_set(
            [&] { EXPECT_EQ(fractions_of(scene.patches, scene.patches, all, scene.pairs, options), right); });
      }
    }
  }
  EXPECT_GT(partly, 20U);
}

TEST(RayTrees, LetThroughTheLightThatTrianglesOneByOneDo) {
  const std::vector<Vec3> lights{{0, 0, 1}, {0, 0, -1}, {1, 0.001F, 0}, {0.5F, -0.7F, 0.3F}};
  for (const Mesh mesh : meshes) {
    SCOPED_TRACE(testing::Message() << "mesh " << static_cast<unsigned>(mesh));
    const GroupScene scene(mesh, 100);
    std::vector<float> right(lights.size() * scene.patches.size());
    lit_fractions(scene.patches, scene.in_groups_of(1), lights, right);
    const Occluders all = scene.in_groups_of(scene.triangles.size());
    on_each_instruction_set([&] {
      std::vector<float> fractions(right.size());
      lit_fractions(scene.patches, all, lights, fractions);
      EXPECT_EQ(fractions, right);
    });
  }
}

// Ways along an axis have inverses that are no finite floats.
TEST(RayTrees, LetNothingThroughAClosedSheetOfAnySize) {
  constexpr int pieces = 17;
  for (int exponent = -120; exponent <= 120; exponent += 5) {
    const auto point = [&](float x, float y, float z) {
      return Vec3{std::ldexp(x, exponent), std::ldexp(y, exponent), std::ldexp(z, exponent)};
    };
    std::vector<Triangle> sheet;
    const auto at = [&](int i, int j) {
      return point(2 * static_cast<float>(i) / pieces - 1, 2 * static_cast<float>(j) / pieces - 1, 0);
    };
    for (int i = 0; i != pieces; ++i) {
      for (int j = 0; j != pieces; ++j) {
        sheet.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
        sheet.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
    }
    const PatchSet patches(std::vector<Vec3>{point(-0.5F, -0.5F, -1), point(0.5F, -0.5F, -1), point(0.5F, 0.5F, -1),
                                             point(-0.5F, 0.5F, -1), point(-0.6F, -0.6F, 1), point(-0.6F, 0.6F, 1),
                                             point(0.6F, 0.6F, 1), point(0.6F, -0.6F, 1)},
                           std::vector<std::size_t>{0, 4, 8});
    Occluders occluders;
    const std::vector<std::size_t> group{0, sheet.size()};
    occluders.add_triangles(TriangleStream(std::span<const Triangle>(sheet)), group);
    std::vector<float> lit(2);
    on_each_instruction_set([&] {
      EXPECT_EQ(fractions_of(patches, patches, occluders, {{0, 1}}, {.rays = 4096})[0], 0) << exponent;
      lit_fractions(patches, occluders, std::vector<Vec3>{{1e-7F, 0, 1}}, lit, {.rays = 4096});
      EXPECT_EQ(lit[0], 0) << exponent;
    });
  }
}

// A node has room for 16 children, a leaf for 16 triangles.
TEST(RayTrees, HaveAllTrianglesOfGroupsOfAnySize) {
  const PatchSet patches(
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}},
      std::vector<std::size_t>{0, 4, 8});
  for (const std::size_t size : {512U, 513U, 528U, 529U, 4095U, 4096U, 4097U, 4112U, 4113U}) {
    // Far away, but for one which is in the way.
    for (const std::size_t place : {std::size_t{0}, size / 2, size - 1}) {
      std::vector<Triangle> triangles;
      for (std::size_t i = 0; i != size; ++i) {
        const float x = 10 + static_cast<float>(i);
        triangles.push_back(i == place ? Triangle{{Vec3{-9, -9, 1}, {18, -9, 1}, {-9, 18, 1}}}
                                       : Triangle{{Vec3{x, 0, 1}, {x + 1, 0, 1}, {x, 1, 1}}});
      }
      Occluders occluders;
      const std::vector<std::size_t> group{0, size};
      occluders.add_triangles(TriangleStream(std::span<const Triangle>(triangles)), group);
      EXPECT_EQ(fractions_of(patches, patches, occluders, {{0, 1}})[0], 0) << size << ", " << place;
    }
  }
}

}  // namespace
}  // namespace shaftcull
