// SPDX-License-Identifier: MIT
/// Rays and view factors of the C interface, against those of C++.
#include "shaftcull/view_factors.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "handles.hpp"
#include "oracle/random.hpp"
#include "shaftcull.h"
#include "shaftcull/rays.hpp"

namespace shaftcull {
namespace {

/// Squares with a front, for both languages.
struct Squares {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  std::vector<std::uint64_t> c_first{0};

  void add(const std::vector<Vec3>& square) {
    corners.insert(corners.end(), square.begin(), square.end());
    first.push_back(corners.size());
    c_first.push_back(corners.size());
  }
  PatchSet as_cpp() const { return PatchSet(corners, first); }
  PatchesHandle as_c() const {
    return made<PatchesHandle>(shaftcull_patches_create_polygons, corners[0].data(), std::uint64_t{corners.size()},
                               c_first.data(), std::uint64_t{first.size() - 1},
                               shaftcull_patch_sides{SHAFTCULL_PATCH_FRONT});
  }
};

/// 24 squares in two groups that face each other along x, and six solid boxes between the groups.
class CViewFactors : public testing::Test {
 protected:
  CViewFactors() {
    Random random(1805);
    const auto square = [&](float least, float most) {
      const Vec3 at{random.uniform(least, most), random.uniform(-4, 4), random.uniform(-4, 4)};
      return std::vector<Vec3>{at, {at[0], at[1] + 1, at[2]}, {at[0], at[1] + 1, at[2] + 1}, {at[0], at[1], at[2] + 1}};
    };
    Squares squares;
    for (int i = 0; i != 12; ++i) squares.add(square(-9, -5));
    for (int i = 0; i != 12; ++i) {
      std::vector<Vec3> turned = square(5, 9);
      std::ranges::reverse(turned);
      squares.add(turned);
    }
    patches = squares.as_cpp();
    c_patches = squares.as_c();

    std::vector<Box> boxes;
    for (int i = 0; i != 6; ++i) boxes.push_back(random.box(-4, 4, 0.5F, 2.0F));
    const std::vector<shaftcull_box> c_boxes = as_c(boxes);
    const shaftcull_source source = source_of(c_boxes);
    occluders.add_solids(std::span<const Box>(boxes));
    c_occluders = made<OccludersHandle>(shaftcull_occluders_create);
    ok(shaftcull_occluders_add_solids(c_occluders.get(), &source, nullptr));

    c_rays.rays = rays.rays;
    c_rays.error = rays.error;
    c_rays.seed = rays.seed;
    c_rays.tolerance = rays.tolerance;
  }

  PatchSet patches;
  PatchesHandle c_patches;
  Occluders occluders;
  OccludersHandle c_occluders;
  const RayOptions rays{.rays = 32, .error = 0.01, .seed = 7, .tolerance = 0.01F};
  shaftcull_ray_options c_rays = shaftcull_default_ray_options();
};

/// The matrix that the C interface computes.
FactorMatrixHandle matrix_of(const PatchesHandle& patches, const OccludersHandle& occluders,
                             const shaftcull_view_factor_options& options) {
  return made<FactorMatrixHandle>(shaftcull_view_factors, static_cast<const shaftcull_patches*>(patches.get()),
                                  static_cast<const shaftcull_occluders*>(occluders.get()), &options);
}

TEST_F(CViewFactors, VisibleFractionsAreThoseOfCpp) {
  const Visibility seen = collect_visibility(patches, occluders);
  ASSERT_GT(seen.undecided.size(), 10U);
  std::vector<float> wanted(seen.undecided.size());
  visible_fractions(patches, patches, occluders, {seen.undecided, seen.first_candidate, seen.candidates}, wanted, rays);
  const auto result = made<VisibilityHandle>(
      shaftcull_collect_visibility, static_cast<const shaftcull_patches*>(c_patches.get()),
      static_cast<const shaftcull_patches*>(nullptr), static_cast<const shaftcull_occluders*>(c_occluders.get()),
      static_cast<const shaftcull_visibility_options*>(nullptr));
  shaftcull_sight_batch batch;
  ok(shaftcull_visibility_result_describe(result.get(), &batch, nullptr));
  ASSERT_EQ(batch.undecided.count, wanted.size());
  std::vector<float> fractions(wanted.size());
  ok(shaftcull_visible_fractions(c_patches.get(), nullptr, c_occluders.get(), &batch.undecided, &c_rays,
                                 fractions.data()));
  EXPECT_EQ(fractions, wanted);
}

TEST_F(CViewFactors, LitFractionsAreThoseOfCpp) {
  const std::vector<Vec3> suns{{1, 0.2F, 0.1F}, {-1, -0.3F, 0.2F}, {0.5F, 1, 0}};
  std::vector<float> lit(patches.size() * suns.size());
  lit_fractions(patches, occluders, suns, lit, rays);
  std::vector<float> c_lit(lit.size());
  ok(shaftcull_lit_fractions(c_patches.get(), c_occluders.get(), suns[0].data(), suns.size(), &c_rays, c_lit.data()));
  EXPECT_EQ(c_lit, lit);
  EXPECT_TRUE(std::ranges::any_of(lit, [](float part) { return part > 0 && part < 1; }));
}

TEST_F(CViewFactors, TheMatrixIsThatOfCpp) {
  shaftcull_view_factor_options options = shaftcull_default_view_factor_options();
  options.rays = 256;
  options.error = 1e-4;
  options.seed = 9;
  options.least = 1e-4;
  options.tolerance = 0.01F;
  const ViewFactors factors = view_factors(
      patches, occluders, {.rays = 256, .error = 1e-4, .seed = 9, .least = 1e-4, .tolerance = 0.01F, .progress = {}});
  const FactorMatrixHandle matrix = matrix_of(c_patches, c_occluders, options);
  const auto info =
      described(shaftcull_factor_matrix_describe, static_cast<const shaftcull_factor_matrix*>(matrix.get()));
  ASSERT_EQ(info.size, factors.size());
  ASSERT_EQ(info.factors, factors.factor.size());
  ASSERT_GT(info.factors, 50U);
  const auto expect_same = [](const auto* of_c, const auto& of_cpp) {
    EXPECT_TRUE(std::ranges::equal(std::span(of_c, of_cpp.size()), of_cpp));
  };
  expect_same(info.first, factors.first);
  expect_same(info.column, factors.column);
  expect_same(info.factor, factors.factor);
  expect_same(info.area, factors.area);
  expect_same(info.sum, factors.sum);
  expect_same(info.error, factors.error);
  expect_same(info.left_out, factors.left_out);
  EXPECT_EQ(as_cpp(info.counts), factors.counts);
  EXPECT_GT(*std::ranges::max_element(factors.left_out), 0);
}

TEST(CParts, AreThoseOfCpp) {
  Squares squares;
  for (int i = 0; i != 300; ++i) {  // so many that they are in several groups
    const auto x = static_cast<float>(i % 20);
    const int row = i / 20;
    const auto y = static_cast<float>(row);
    const float z = i % 2 == 0 ? 0.0F : 5.0F;
    std::vector<Vec3> square{{x, y, z}, {x + 1, y, z}, {x + 1, y + 1, z}, {x, y + 1, z}};
    if (z != 0) std::ranges::reverse(square);
    squares.add(square);
  }
  const PatchSet patches = squares.as_cpp();
  const PatchesHandle c_patches = squares.as_c();
  const auto nothing = made<OccludersHandle>(shaftcull_occluders_create);
  shaftcull_visibility_options options = shaftcull_default_visibility_options();
  shaftcull_view_factor_options of_factors = shaftcull_default_view_factor_options();
  options.parts = of_factors.parts = 4;
  std::uint64_t with_pairs = 0;
  for (std::uint32_t part = 0; part != 4; ++part) {
    options.part = of_factors.part = part;
    shaftcull_sight_counts counts{};
    ok(shaftcull_visibility(c_patches.get(), nullptr, nothing.get(), &options, nullptr, nullptr, &counts));
    EXPECT_EQ(as_cpp(counts), count_visibility(patches, {}, {.part = part, .parts = 4, .resolve = {}, .progress = {}}));
    with_pairs += counts.clear != 0 ? 1 : 0;
    const FactorMatrixHandle matrix = matrix_of(c_patches, nothing, of_factors);
    const auto info =
        described(shaftcull_factor_matrix_describe, static_cast<const shaftcull_factor_matrix*>(matrix.get()));
    EXPECT_EQ(info.factors, 2 * counts.clear);
  }
  EXPECT_GT(with_pairs, 1U);
}

TEST(CViewFactor, OfTwoPolygonsIsThatOfCpp) {
  Random random(1803);
  std::vector<Vec3> corners;
  for (int i = 0; i != 6; ++i) corners.push_back(random.vec3(-5, 5));
  const std::span<const Vec3> all(corners);
  double factor = -1;
  ok(shaftcull_view_factor(corners[0].data(), 3, corners[3].data(), 3, &factor));
  EXPECT_EQ(factor, view_factor(all.subspan(0, 3), all.subspan(3, 3)));
  EXPECT_GT(factor, 0);
}

}  // namespace
}  // namespace shaftcull
