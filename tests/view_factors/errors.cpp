// SPDX-License-Identifier: MIT
/// Errors of view factors that rays estimate: how large they are, and what is said of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "shaftcull/shaftcull.hpp"
#include "view_factors/radiating_scene.hpp"

namespace shaftcull {
namespace {

TEST(ViewFactors, HaveFewerErrorsWithMoreRays) {
  const RadiatingScene room = furnished_room(1);
  const auto error_with = [&](std::uint32_t rays, double error) {
    ViewFactorOptions options;
    options.rays = rays;
    options.error = error;
    const ViewFactors factors = view_factors(room.patches(), room.occluders(), options);
    return *std::max_element(factors.error.begin(), factors.error.end());
  };
  EXPECT_LT(4 * error_with(1024, 0), error_with(16, 0));
  EXPECT_LT(2 * error_with(65536, 1e-5), error_with(65536, 1e-2));
}

TEST(ViewFactors, DependOnTheSeedWithinTheirErrors) {
  const RadiatingScene room = furnished_room(1);
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  ViewFactorOptions other;
  other.seed = 2;
  const ViewFactors one = view_factors(patches, occluders);
  const ViewFactors two = view_factors(patches, occluders, other);
  EXPECT_NE(one.factor, two.factor);
  for (std::size_t i = 0; i != room.size(); ++i) EXPECT_NEAR(one.sum[i], two.sum[i], 8 * one.error[i] + 1e-9);
}

// Where patches touch, few rays have most of the weight, and many samples of 16 rays have none of these.
TEST(ViewFactors, HaveHonestErrorsOfFewRays) {
  const RadiatingScene room = furnished_room(1);
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  ViewFactorOptions options;
  options.error = 0;
  const ViewFactors exact = view_factors(patches, occluders, options);
  options.rays = 16;
  std::size_t rows = 0;
  std::size_t far_off = 0;
  for (options.seed = 2; options.seed != 32; ++options.seed) {
    const ViewFactors few = view_factors(patches, occluders, options);
    for (std::size_t i = 0; i != room.size(); ++i) {
      if (few.error[i] == 0) continue;
      ++rows;
      if (std::abs(few.sum[i] - exact.sum[i]) > 3 * few.error[i]) ++far_off;
    }
  }
  EXPECT_GT(rows, 1000U);
  EXPECT_LE(far_off, rows / 300);  // as of errors that are normally distributed
}

// Of the many pairs that see each other through a narrow gap, the first rays mostly meet the box. If no more were cast
// then, sums would be too small.
TEST(ViewFactors, AreNotSmallerWhereTheFirstRaysMeetSomething) {
  RadiatingScene room;
  room.add_box({{0, 0, 0}, {4, 4, 2}}, 8, true);
  room.add_box({{1, 1, 0.125F}, {3, 3, 1}}, 4, false);
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  ViewFactorOptions options;
  options.rays = 16'384;
  options.error = 0;
  const ViewFactors exact = view_factors(patches, occluders, options);
  options.error = 3e-4;
  double all = 0;
  double squares = 0;
  for (options.seed = 2; options.seed != 8; ++options.seed) {
    const ViewFactors factors = view_factors(patches, occluders, options);
    for (std::size_t i = 0; i != room.size(); ++i) {
      all += factors.sum[i] - exact.sum[i];
      squares += 2 * factors.error[i] * factors.error[i];  // each pair is in two rows
    }
  }
  EXPECT_LT(std::fabs(all), 3 * std::sqrt(squares)) << all << ", " << std::sqrt(squares);
}

}  // namespace
}  // namespace shaftcull
