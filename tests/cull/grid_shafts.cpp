// SPDX-License-Identifier: MIT
/// What shafts on a grid may be off by, which random bounds seldom show (docs/exactness.md, "On a grid").
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "cull/agreement.hpp"
#include "dispatch/active_kernels.hpp"
#include "instruction_sets.hpp"
#include "kernels/grid/forming.hpp"
#include "kernels/kernel_table.hpp"
#include "oracle/cases/shafts.hpp"
#include "oracle/grid_answers.hpp"
#include "oracle/random.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull {
namespace {

using kernel::GridFrame;
using kernel::GridShaft;

/// A face on a grid, as a near corner is compared with it.
struct GridFace {
  double middle;
  double travel;
};

/// The first and the last box of a shaft on a grid.
struct Ends {
  Box a;
  Box b;
};

GridFace face_of(const Ends& shaft, const GridFrame& frame, std::uint8_t near_stream) {
  const bool is_lo = near_stream >= 3;  // the bound's hi corner is near the lo face
  const std::size_t k = near_stream % 3;
  const auto on_grid = [&](const Box& box) {
    const double x = static_cast<double>(is_lo ? box.lo[k] : box.hi[k]) - static_cast<double>(frame.origin[k]);
    return (is_lo ? -x : x) * static_cast<double>(frame.steps[k]);
  };
  return {0.5 * (on_grid(shaft.a) + on_grid(shaft.b)), on_grid(shaft.b) - on_grid(shaft.a)};
}

/// What the kernels compute of a coordinate.
int product(int coordinate, int scale) { return (coordinate * scale + (1 << 14)) >> 15; }

void expect_bounds_within_slack(const Ends& shaft, const GridFrame& frame, const GridShaft& grid) {
  constexpr double floats = 0.01;
  constexpr auto most = static_cast<int>(kernel::grid_top);
  const unsigned moving = 6U - grid.stationary;
  GridFace reference{};
  if (moving != 0) {
    reference = face_of(shaft, frame, grid.near_stream[0]);
    const double half = 0.5 * std::abs(reference.travel);
    EXPECT_LE(grid.begin, reference.middle - half + floats);
    EXPECT_GE(grid.begin, reference.middle - half - 1 - static_cast<double>(kernel::float_slack) - floats);
    EXPECT_GE(grid.end, reference.middle + half - floats);
    EXPECT_LE(grid.end, reference.middle + half + 1 + static_cast<double>(kernel::float_slack) + floats);
  }
  for (unsigned i = moving == 0 ? 0 : 1; i != 6; ++i) {
    const GridFace face = face_of(shaft, frame, grid.near_stream[i]);
    const bool is_stationary = i >= moving;
    const bool is_upper = i <= grid.uppers;
    const double half = 0.5 * std::abs(face.travel);
    const double scale = reference.travel / face.travel;
    ASSERT_EQ(is_stationary, 2 * half < static_cast<double>(kernel::most_stationary_travel));
    ASSERT_TRUE(is_stationary || is_upper == (scale < 0));
    ASSERT_TRUE(is_stationary || std::abs(scale) <= 1) << "the reference face moves least";
    // What is cut off, too, stays within 16 bits.
    for (const int q : {-most, most}) {
      const int computed = is_stationary ? grid.shift[i] - q : product(q, grid.scale[i]) + grid.shift[i];
      ASSERT_LE(std::abs(computed), std::numeric_limits<std::int16_t>::max());
    }
    const double by_scale = is_stationary ? 0 : half * std::abs(static_cast<double>(grid.scale[i]) * 0x1p-15 - scale);
    const double step = std::max(1.0, half / 500);
    const int steps = static_cast<int>(2 * half / step);
    for (int at = 0; at <= steps; ++at) {
      const int q = static_cast<int>(std::floor(face.middle - half + at * step));
      if (std::abs(q) > most) continue;  // of a shaft that leaves the frame
      const int computed = is_stationary ? grid.shift[i] - q : product(q, grid.scale[i]) + grid.shift[i];
      const double exact = is_stationary ? face.middle + half - q : reference.middle + scale * (q - face.middle);
      const double permissive = is_stationary || is_upper ? computed - exact : exact - computed;
      ASSERT_GT(permissive, -0.5) << "at " << q << ", constraint "
                                  << i;  // two of them: less than one step, and all are integers
      ASSERT_LT(permissive, static_cast<double>(kernel::bound_slack + kernel::bound_error) + 2 * by_scale + floats)
          << "at " << q << ", constraint " << i;
    }
  }
}

TEST(GridShafts, BoundsOnTAreOffByLessThanTheirSlack) {
  constexpr std::uint64_t seed = 191;
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::GridKernels& kernels = kernel::active_kernels().grid;
    if (kernels.frame == nullptr) continue;
    Random random(seed);
    std::size_t on_a_grid = 0;
    for (unsigned group = 0; group != 40; ++group) {
      std::vector<CompiledShaft> shafts;
      for (unsigned i = 0; i != 16; ++i) {
        const ShaftInput input = i % 4 == 0   ? nearly_equal_shaft(random)
                                 : i % 4 == 1 ? distant_shaft(random, std::ldexp(1.0F, static_cast<int>(group % 16)))
                                              : random_shaft(random);
        shafts.push_back(compile(input.a, input.b));
      }
      const std::span<const kernel::ShaftData> data = kernel::data_of(std::span<const CompiledShaft>(shafts));
      const GridFrame frame = kernels.frame(data.data(), data.size(), nullptr);
      ASSERT_TRUE(frame.exists());
      std::vector<GridShaft> on_grid(shafts.size());
      kernels.form_shafts(data.data(), data.size(), nullptr, frame, on_grid.data());
      for (std::size_t s = 0; s != shafts.size() && !HasFailure(); ++s) {
        if (!on_grid[s].exists) continue;
        expect_bounds_within_slack({shafts[s].a(), shafts[s].b()}, frame, on_grid[s]);
        ++on_a_grid;
      }
    }
    EXPECT_GT(on_a_grid, 600U) << "of 640";
  }
}

TEST(GridShafts, BoundsOnTAreOffByLessThanTheirSlackWhereAShaftLeavesTheFrame) {
  constexpr std::uint64_t seed = 192;
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::GridKernels& kernels = kernel::active_kernels().grid;
    if (kernels.frame == nullptr) continue;
    Random random(seed);
    std::size_t on_a_grid = 0;
    for (unsigned group = 0; group != 40; ++group) {
      std::vector<CompiledShaft> shafts;
      std::vector<kernel::ClippedEnd> clipped;
      std::vector<Ends> ends;
      for (unsigned i = 0; i != 16; ++i) {
        const Box a = random.box(-5, 5, 0.1F, 1);
        const float beyond = random.uniform(1, 40);  // it spreads, and of the first axis both faces follow it
        const float along = random.uniform(-6, 6);
        const Box b{{along, a.lo[1] - beyond, a.lo[2] - random.uniform(0.1F, 1) * beyond},
                    {along + 0.5F, a.hi[1] + random.uniform(0.1F, 1) * beyond, a.hi[2] + beyond}};
        shafts.push_back(swept_infinite(a, {1, 0, 0}));  // its end is what counts here
        ends.push_back({a, b});
        kernel::ClippedEnd end{};
        for (unsigned k = 0; k != 3; ++k) {
          end.face[k] = b.lo[k];
          end.face[k + 3] = b.hi[k];
          end.in_frame[k] = std::clamp(b.lo[k], -7.0F, 7.0F);
          end.in_frame[k + 3] = std::clamp(b.hi[k], -7.0F, 7.0F);
        }
        clipped.push_back(end);
      }
      const std::span<const kernel::ShaftData> data = kernel::data_of(std::span<const CompiledShaft>(shafts));
      const GridFrame frame = kernels.frame(data.data(), data.size(), clipped.data());
      ASSERT_TRUE(frame.exists());
      for (const float steps : frame.steps) EXPECT_GE(steps, kernel::grid_edge / 7.5F) << "holds what is far away";
      std::vector<GridShaft> on_grid(shafts.size());
      kernels.form_shafts(data.data(), data.size(), clipped.data(), frame, on_grid.data());
      for (std::size_t s = 0; s != shafts.size() && !HasFailure(); ++s) {
        if (!on_grid[s].exists) continue;
        expect_bounds_within_slack(ends[s], frame, on_grid[s]);
        ++on_a_grid;
      }
    }
    EXPECT_GT(on_a_grid, 550U) << "of 640";
  }
}

TEST(GridShafts, WhatOtherTestsAskIsAskedOnAGrid) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::GridKernels& kernels = kernel::active_kernels().grid;
    EXPECT_TRUE(kernels.frame == nullptr || kernels.pays(shafts_on_grid, bounds_on_grid)) << name(isa);
  }
}

}  // namespace
}  // namespace shaftcull
