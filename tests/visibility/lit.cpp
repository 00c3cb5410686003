// SPDX-License-Identifier: MIT
/// Lit fractions: scenes in which they are known, and rays in doubles, straight from the definition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

std::vector<float> lit_of(const PatchSet& patches, const Occluders& occluders, const std::vector<Vec3>& directions,
                          const RayOptions& options = {}) {
  std::vector<float> fractions(patches.size() * directions.size(), -1);
  lit_fractions(patches, occluders, directions, fractions, options);
  return fractions;
}

/// The unit square at z = 0, moved, which faces up.
PatchSet square_at(const Vec3& at, PatchSides sides = PatchSides::front, float size = 1) {
  const auto corner = [&](float x, float y) { return Vec3{at[0] + size * x, at[1] + size * y, at[2]}; };
  return PatchSet(std::vector<Vec3>{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)},
                  std::vector<std::size_t>{0, 4}, sides);
}

TEST(LitFraction, IsAllInTheOpenAndNoneOfWhatFacesAway) {
  const std::vector<Vec3> lights{{0, 0, 1},      {3, -2, 1e-3F},    {0, 0, -1},
                                 {1, 0, -1e-3F}, {1e30F, 0, 1e30F}, {0, 0, 1e-30F}};
  const PatchSet patch = square_at({0, 0, 0});
  EXPECT_EQ(lit_of(patch, {}, lights), (std::vector<float>{1, 1, 0, 0, 1, 1}));
  const PatchSet both_sides = square_at({0, 0, 0}, PatchSides::both);
  EXPECT_EQ(lit_of(both_sides, {}, lights), std::vector<float>(6, 1.0F));
  // What is behind the patch, or beside its way to the light, hides nothing.
  Occluders aside;
  aside.add_solids(std::vector<Box>{{{0, 0, -2}, {1, 1, -1}}, {{2, 0, 1}, {3, 1, 2}}});
  EXPECT_EQ(lit_of(patch, aside, {{0, 0, 1}}), (std::vector<float>{1}));
  EXPECT_EQ(lit_of(patch, {}, {}), std::vector<float>());
  // A patch without an area sees on no side, nor does one towards a light in its plane.
  for (const PatchSides sides : {PatchSides::front, PatchSides::both}) {
    const PatchSet line(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, std::vector<std::size_t>{0, 3}, sides);
    EXPECT_EQ(lit_of(line, {}, {{0, 0, 1}}), (std::vector<float>{0}));
    EXPECT_EQ(lit_of(square_at({0, 0, 0}, sides), {}, {{1, 0, 0}}), (std::vector<float>{0}));
  }
  EXPECT_EQ(lit_of(PatchSet(), aside, lights), std::vector<float>());
}

// A wall above x from −1 to 0.5 at z = 1, of each kind. Its shadow moves as the light does.
TEST(LitFraction, IsWhatTheShadowOfAWallLeaves) {
  const std::vector<Vec3> corners{{-1, -1, 1}, {0.5F, -1, 1}, {0.5F, 2, 1}, {-1, 2, 1}};
  std::vector<Occluders> walls(6);
  walls[0].add_polygons(corners, std::vector<std::size_t>{0, 4});
  walls[1].add_solids(std::vector<Box>{{{-1, -1, 1}, {0.5F, 2, 1}}});
  walls[2].add_solids(std::vector<Box>{{{-1, -1, 0.9995F}, {0.5F, 2, 1.0005F}}});
  walls[3].add_boxes(std::vector<Box>{{{-1, -1, 0.9995F}, {0.5F, 2, 1.0005F}}});
  std::vector<Vec3> prism;
  for (const Vec3& corner : corners) {
    for (const float z : {0.9995F, 1.0005F}) prism.push_back({corner[0], corner[1] + (corner[1] > 0 ? 0.01F : 0), z});
  }
  walls[4].add_solid_hulls(prism, std::vector<std::size_t>{0, prism.size()});
  walls[5].add_triangles(TriangleStream(std::vector<Triangle>{{{corners[0], corners[1], corners[2]}},
                                                              {{corners[0], corners[3], corners[2]}}})
                             .view());
  const std::vector<Vec3> lights{{0, 0, 1}, {-0.25F, 0, 1}, {1, 0, 2}, {-1, 0, 1}, {1, 0, 1}, {0, 5, 1}, {0, 1.75F, 1}};
  const std::vector<double> lit{0.5, 0.25, 1, 0, 1, 1, 0.5 + 0.5 * 0.75};
  for (std::size_t w = 0; w != walls.size(); ++w) {
    const std::vector<float> found = lit_of(square_at({0, 0, 0}), walls[w], lights, {.rays = 4096});
    for (std::size_t i = 0; i != lights.size(); ++i) EXPECT_NEAR(found[i], lit[i], 0.01) << w << ", " << i;
  }
}

// 64 rays are far better than random ones, whose error would be 0.054 here.
TEST(LitFraction, IsKnownByFewRays) {
  Occluders wall;
  wall.add_polygons(std::vector<Vec3>{{-1, -1, 1}, {0.25F, -1, 1}, {0.25F, 2, 1}, {-1, 2, 1}},
                    std::vector<std::size_t>{0, 4});
  double squares = 0;
  constexpr int seeds = 200;
  for (int seed = 0; seed != seeds; ++seed) {
    const float lit = lit_of(square_at({0, 0, 0}), wall, {{0, 0, 1}}, {.seed = static_cast<std::uint64_t>(seed)})[0];
    squares += (lit - 0.75) * (lit - 0.75);
  }
  EXPECT_LT(std::sqrt(squares / seeds), 0.02);
}

TEST(LitFraction, IsTheSameAtAnyPlaceAndOfAnySize) {
  for (const float size : {0x1p-60F, 1.0F, 0x1p60F}) {
    for (const float far : {0.0F, 4096.0F}) {
      const Vec3 at{far * size, -far * size, 2 * far * size};
      const auto moved = [&](float x, float y, float z) {
        return Vec3{at[0] + x * size, at[1] + y * size, at[2] + z * size};
      };
      Occluders wall;
      wall.add_polygons(std::vector<Vec3>{moved(-1, -1, 1), moved(0.5F, -1, 1), moved(0.5F, 2, 1), moved(-1, 2, 1)},
                        std::vector<std::size_t>{0, 4});
      const std::vector<float> found =
          lit_of(square_at(at, PatchSides::front, size), wall, {{0, 0, 1}, {-0.25F, 0, 1}}, {.rays = 4096});
      EXPECT_NEAR(found[0], 0.5, 0.01) << size << ", " << far;
      EXPECT_NEAR(found[1], 0.25, 0.01) << size << ", " << far;
    }
  }
}

// Each side of a box is lit from half of all directions, wholly. It lies on the box and on its neighbours.
TEST(LitFraction, IsNotLessForTheBodyThatThePatchIsASideOf) {
  const std::vector<Vec3> v{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}};
  const std::array<std::array<std::size_t, 4>, 6> sides{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}}};
  for (const double angle : {0.0, 0.4}) {
    const auto turned = [&](const Vec3& p) {
      const double x = p[0] * std::cos(angle) - p[1] * std::sin(angle);
      const double y = p[0] * std::sin(angle) + p[1] * std::cos(angle);
      return Vec3{static_cast<float>(x) + 100, static_cast<float>(y) + 100, p[2]};
    };
    std::vector<Vec3> corners;
    std::vector<std::size_t> first{0};
    std::vector<Triangle> triangles;
    for (const auto& side : sides) {
      for (const std::size_t c : side) corners.push_back(turned(v[c]));
      first.push_back(corners.size());
      const std::span<const Vec3> of = std::span(corners).last(4);
      triangles.push_back({{of[0], of[1], of[2]}});
      triangles.push_back({{of[0], of[2], of[3]}});
    }
    Occluders body;
    body.add_triangles(TriangleStream(triangles).view());
    Random random(5);
    std::vector<Vec3> lights;
    for (std::size_t i = 0; i != 40; ++i) lights.push_back(random.vec3(-1, 1));
    const std::vector<float> lit = lit_of(PatchSet(corners, first), body, lights, {.tolerance = 1e-4F});
    std::size_t all = 0;
    for (const float fraction : lit) {
      EXPECT_TRUE(fraction == 0 || fraction == 1) << fraction;
      all += fraction == 1 ? 1 : 0;
    }
    EXPECT_EQ(all, 3 * lights.size());
  }
}

// Such as a patch whose corners were rounded into the solid that it lies on.
TEST(LitFraction, IsNotLessForASolidThatReachesOverThePatchByLessThanTheTolerance) {
  Occluders box;
  box.add_solids(std::vector<Box>{{{-10, -10, -5}, {10, 10, 0.001F}}});
  Occluders hull;
  std::vector<Vec3> wedge;
  for (const float x : {-10.0F, 10.0F}) {
    for (const float y : {-10.0F, 10.0F}) {
      wedge.push_back({x, y, 0.001F});
      wedge.push_back({x / 2, y, -5});
    }
  }
  hull.add_solid_hulls(wedge, std::vector<std::size_t>{0, wedge.size()});
  const std::vector<Vec3> lights{{0, 0, 1}, {3, 1, 1}};
  for (const Occluders& solid : {box, hull}) {
    EXPECT_EQ(lit_of(square_at({0, 0, 0}), solid, lights, {.tolerance = 0.002F}), std::vector<float>(2, 1.0F));
    EXPECT_EQ(lit_of(square_at({0, 0, 0}), solid, lights), std::vector<float>(2));
  }
}

// Solids that touch have no gaps between them, however large coordinates are; and a thin one hides what a thick one
// does.
TEST(LitFraction, IsNoneUnderSolidsThatTouchAtAnyPlace) {
  for (const float far : {0.0F, 1000.0F, 32768.0F, 524288.0F}) {
    const auto at = [&](float x, float y, float z) { return Vec3{far + x, y, z}; };
    const PatchSet floor(std::vector<Vec3>{at(-8, -8, 0), at(8, -8, 0), at(8, 8, 0), at(-8, 8, 0)},
                         std::vector<std::size_t>{0, 4});
    Occluders boxes;
    Occluders hulls;
    for (int i = -16; i != 16; ++i) {
      const auto x = static_cast<float>(i);
      boxes.add_solids(std::vector<Box>{{at(x, -16, 8), at(x + 1, 16, 8.25F)}});
      std::vector<Vec3> prism;  // no box: its ends lean
      for (const float z : {8.0F, 8.25F}) {
        for (const float y : {-16.0F, 16.0F}) {
          prism.push_back(at(x, y + 4 * (z - 8), z));
          prism.push_back(at(x + 1, y + 4 * (z - 8), z));
        }
      }
      hulls.add_solid_hulls(prism, std::vector<std::size_t>{0, prism.size()});
    }
    const std::vector<Vec3> lights{{0, 0, 1}, {0, 0.5F, 1}};
    EXPECT_EQ(lit_of(floor, boxes, lights, {.rays = 4096}), std::vector<float>(2)) << far;
    EXPECT_EQ(lit_of(floor, hulls, lights, {.rays = 4096}), std::vector<float>(2)) << far;
  }
}

using Triple = std::array<double, 3>;
Triple triple(const Vec3& p) { return {p[0], p[1], p[2]}; }
Triple way_of(const Triple& p, const Triple& q) { return {q[0] - p[0], q[1] - p[1], q[2] - p[2]}; }
double dot_of(const Triple& p, const Triple& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
Triple cross_of(const Triple& p, const Triple& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// Whether a ray without end meets a triangle.
bool meets(const Triple& from, const Triple& way, const Triangle& triangle) {
  const Triple corner = triple(triangle.vertex[0]);
  const Triple u = way_of(corner, triple(triangle.vertex[1]));
  const Triple v = way_of(corner, triple(triangle.vertex[2]));
  const double volume = dot_of(cross_of(u, v), way);
  if (volume == 0) return false;
  const Triple at = way_of(corner, from);
  const double t = -dot_of(cross_of(u, v), at) / volume;
  const double of_u = dot_of(cross_of(way, v), at) / -volume;
  const double of_v = dot_of(cross_of(u, way), at) / -volume;
  return t > 0 && of_u >= 0 && of_v >= 0 && of_u + of_v <= 1;
}

/// Likewise a box, which may be flat.
bool meets(const Triple& from, const Triple& way, const Box& box) {
  double first = 0;
  double last = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k != 3; ++k) {
    const double one = (box.lo[k] - from[k]) / way[k];
    const double other = (box.hi[k] - from[k]) / way[k];
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first <= last;
}

/// Triangles above triangles, and boxes, not in line with anything.
struct LitScene {
  std::vector<Vec3> corners;
  std::vector<Triangle> triangles;
  std::vector<Box> solids;
  std::vector<Vec3> lights;
  PatchSet patches;
  Occluders occluders;

  explicit LitScene(std::uint64_t seed) {
    Random random(seed);
    const auto triangle_near = [&](const Vec3& at, float reach) {
      Triangle triangle{};
      for (Vec3& vertex : triangle.vertex) {
        const Vec3 way = random.vec3(-reach, reach);
        for (std::size_t k = 0; k != 3; ++k) vertex[k] = at[k] + way[k];
      }
      return triangle;
    };
    std::vector<std::size_t> first{0};
    for (std::size_t i = 0; i != 120; ++i) {
      const Triangle patch = triangle_near(random.vec3(-2, 2), 0.5F);
      corners.insert(corners.end(), patch.vertex.begin(), patch.vertex.end());
      first.push_back(corners.size());
    }
    for (std::size_t i = 0; i != 20; ++i) triangles.push_back(triangle_near(random.vec3(-3, 3), 1));
    for (std::size_t i = 0; i != 4; ++i) solids.push_back(random.box(-4, 4, 0.2F, 1.5F));
    for (std::size_t i = 0; i != 6; ++i) lights.push_back(random.vec3(-1, 1));
    patches = PatchSet(corners, first);
    occluders.add_solids(solids);
    occluders.add_triangles(TriangleStream(triangles).view());
  }

  /// Whether a point of a patch is lit.
  [[nodiscard]] bool is_lit(const Triple& from, const Triple& way) const {
    return std::none_of(triangles.begin(), triangles.end(), [&](const Triangle& of) { return meets(from, way, of); }) &&
           std::none_of(solids.begin(), solids.end(), [&](const Box& of) { return meets(from, way, of); });
  }

  /// By many rays from random points.
  [[nodiscard]] double lit(std::size_t patch, const Vec3& light, Random& random) const {
    const Triple corner = triple(corners[3 * patch]);
    const Triple u = way_of(corner, triple(corners[3 * patch + 1]));
    const Triple v = way_of(corner, triple(corners[3 * patch + 2]));
    if (dot_of(cross_of(u, v), triple(light)) <= 0) return 0;
    constexpr std::size_t rays = 3000;
    std::size_t seen = 0;
    for (std::size_t i = 0; i != rays; ++i) {
      double s = random.uniform(0, 1);
      double t = random.uniform(0, 1);
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const Triple from{corner[0] + s * u[0] + t * v[0], corner[1] + s * u[1] + t * v[1],
                        corner[2] + s * u[2] + t * v[2]};
      seen += is_lit(from, triple(light)) ? 1 : 0;
    }
    return static_cast<double>(seen) / rays;
  }
};

TEST(LitFraction, IsThatOfRaysInDoubles) {
  constexpr std::size_t step = has_shadow_memory ? 6 : 1;
  std::size_t partly = 0;
  for (std::uint64_t seed = 1; seed != 3; ++seed) {
    const LitScene scene(seed);
    const std::vector<float> found = lit_of(scene.patches, scene.occluders, scene.lights, {.rays = 4096});
    Random random(seed);
    for (std::size_t i = 0; i < scene.patches.size(); i += step) {
      for (std::size_t j = 0; j != scene.lights.size(); ++j) {
        const double right = scene.lit(i, scene.lights[j], random);
        EXPECT_NEAR(found[i * scene.lights.size() + j], right, 0.04) << seed << ": " << i << ", " << j;
        partly += right > 0 && right < 1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(partly, 100U / step);
}

TEST(LitFraction, IsTheSameBitsOnEveryInstructionSetAndOneByOne) {
  const LitScene scene(3);
  for (const RayOptions& options : {RayOptions{}, RayOptions{.rays = 1}, RayOptions{.rays = 1000, .error = 0.05}}) {
    const std::vector<float> right = lit_of(scene.patches, scene.occluders, scene.lights, options);
    on_each_instruction_set([&] { EXPECT_EQ(lit_of(scene.patches, scene.occluders, scene.lights, options), right); });
    // Those of the first patches and lights do not depend on what follows.
    const PatchSet some(std::span(scene.corners).first(9), std::vector<std::size_t>{0, 3, 6, 9});
    const std::vector<float> few = lit_of(some, scene.occluders, {scene.lights[0], scene.lights[1]}, options);
    for (std::size_t i = 0; i != 3; ++i) {
      for (std::size_t j = 0; j != 2; ++j) EXPECT_EQ(few[2 * i + j], right[scene.lights.size() * i + j]);
    }
  }
}

TEST(LitFraction, DependsOnTheSeedAndTheErrorAsFarAsItMay) {
  const LitScene scene(4);
  const std::vector<float> exact = lit_of(scene.patches, scene.occluders, scene.lights, {.rays = 65536});
  const std::vector<float> other = lit_of(scene.patches, scene.occluders, scene.lights, {.seed = 2});
  const std::vector<float> rough = lit_of(scene.patches, scene.occluders, scene.lights, {.rays = 65536, .error = 0.02});
  EXPECT_NE(lit_of(scene.patches, scene.occluders, scene.lights), other);
  EXPECT_NE(exact, rough);
  for (std::size_t i = 0; i != exact.size(); ++i) EXPECT_NEAR(exact[i], rough[i], 0.15) << i;
}

TEST(LitFraction, RefusesWhatHasNone) {
  const PatchSet patch = square_at({0, 0, 0});
  std::vector<float> fractions(2);
  const auto refused = [&](const PatchSet& patches, const std::vector<Vec3>& lights, const RayOptions& options = {}) {
    std::string message = message_of([&] { lit_fractions(patches, {}, lights, fractions, options); });
    EXPECT_EQ(fractions, std::vector<float>(2));
    return message;
  };
  EXPECT_EQ(refused(patch, {{0, 0, 1}}), "fractions has 2 elements; one for each patch and direction are 1 · 1 = 1");
  EXPECT_EQ(refused(patch, {{0, 0, 1}, {0, 0, 0}}), "directions[1] is (0, 0, 0); it is finite and not 0");
  EXPECT_THAT(refused(patch, {{0, HUGE_VALF, 1}, {0, 0, 1}}), HasSubstr("directions[0] is (0, inf, 1)"));
  EXPECT_THAT(refused(patch, {{0, NAN, 1}, {0, 0, 1}}), HasSubstr("it is finite and not 0"));
  const std::vector<Vec3> lights{{0, 0, 1}, {0, 1, 1}};
  EXPECT_EQ(refused(patch, lights, {.rays = 0}), "rays is 0; a pair gets 1 to 65536");
  EXPECT_EQ(refused(patch, lights, {.rays = 65537}), "rays is 65537; a pair gets 1 to 65536");
  EXPECT_THAT(refused(patch, lights, {.error = -1}), HasSubstr("error is -1"));
  EXPECT_THAT(refused(patch, lights, {.tolerance = -1}), HasSubstr("tolerance is -1"));
  EXPECT_THAT(refused(PatchSet(std::vector<Box>{{{0, 0, 0}, {1, 1, 1}}}), lights), HasSubstr("patch"));
}

}  // namespace
}  // namespace shaftcull
