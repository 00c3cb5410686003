// SPDX-License-Identifier: MIT
/// Segments that certainly pass through a triangle: exact planes never leave such a triangle out, and ordinary
/// triangles in the way are found.
#include "exact/deep_segments.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "exact/patch_plane.hpp"
#include "exact/tangent_planes.hpp"
#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

using kernel::most_siblings;
using kernel::SegmentStart;
using Corners = std::array<Vec3, 3>;

/// Triangles with corners that are small integers times a factor, some of them moved to the next float.
class Triangles {
 public:
  explicit Triangles(std::uint64_t seed) : random_(seed) {
    constexpr float factors[] = {1, 0.37F, 0x1p-20F, 1e6F, 0x1p-59F, 0x1p56F};
    factor_ = factors[random_.below(6)];
    offset_ = random_.one_in(4) ? 1e4F : 0;
  }
  [[nodiscard]] Corners next(float x, int reach) {
    Corners corners{};
    for (Vec3& corner : corners) {
      for (std::size_t k = 0; k != 3; ++k) {
        const float at = (k == 0 ? x : 0) + random_.integer(-reach, reach);
        corner[k] = (at + offset_) * factor_;
        if (random_.one_in(4)) corner[k] = random_.nudge(corner[k]);
      }
    }
    return corners;
  }
  [[nodiscard]] float coordinate() const { return (offset_ + 64) * factor_; }
  [[nodiscard]] float tolerance() {
    return random_.one_in(2) ? 0 : std::ldexp(coordinate(), -6 - static_cast<int>(random_.below(19)));
  }

 private:
  Random random_;
  float factor_ = 1;
  float offset_ = 0;
};

/// Streams of one corner of each triangle.
struct EndStreams {
  std::array<std::array<float, 2 * most_siblings>, 3> of{};
  const float* stream[3];

  explicit EndStreams(const std::vector<Corners>& triangles, std::size_t corner) {
    for (std::size_t k = 0; k != 3; ++k) {
      for (std::size_t i = 0; i != triangles.size(); ++i) of[k][i] = triangles[i][corner][k];
      stream[k] = of[k].data();
    }
  }
};

TEST(DeepSegments, PassThroughNoTriangleThatExactPlanesLeaveOut) {
  std::uint64_t through = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(400); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Triangles triangles(seed);
    const Corners a = triangles.next(-12, 5);
    std::vector<Corners> others;
    while (others.size() != most_siblings) others.push_back(triangles.next(12, 5));
    const EndStreams ends(others, 1);
    const auto coordinate = double{triangles.coordinate()};
    const float tolerance = triangles.tolerance();
    const SegmentStart start(a[0], a[1], a[2], coordinate);
    std::array<float, most_siblings> least{};
    for (std::size_t i = 0; i != others.size(); ++i) {
      least[i] = start.least_distance(others[i][1], double{tolerance});
    }
    for (int i = 0; i != 6; ++i) {
      const Corners between = triangles.next(0, 11);
      const kernel::SeenTriangle seen = kernel::seen_triangle(start.point(), between, coordinate);
      std::uint64_t left_out = 0;
      for (std::size_t lane = 0; lane != others.size(); ++lane) {
        kernel::TangentPlanes planes;
        planes.begin({a, false}, {others[lane], false});
        const bool is_separate = planes.separate({between, nullptr}, Contact::open, tolerance) ||
                                 kernel::are_on_one_side(a, others[lane], between, Contact::open, tolerance);
        left_out |= std::uint64_t{is_separate} << lane;
      }
      on_each_instruction_set([&] {
        const auto& kernels = kernel::active_kernels().siblings;
        for (const std::uint64_t asked : {~std::uint64_t{0}, std::uint64_t{0x3333333333333333}}) {
          const std::uint64_t found = kernels.segments_through(seen, ends.stream, least.data(), most_siblings, asked);
          ASSERT_EQ(found & (left_out | ~asked), 0U);
          through += static_cast<std::uint64_t>(std::popcount(found));
        }
      });
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(through, random_cases(1000));
}

TEST(DeepSegments, PassThroughTheMiddleOfATriangleBetweenTwoOthers) {
  const Corners a{Vec3{0, -1, -1}, Vec3{0, 1, -1}, Vec3{0, 0, 1}};
  const Corners between{Vec3{5, -4, -4}, Vec3{5, 4, -4}, Vec3{5, 0, 8}};
  const Corners beside{Vec3{5, 4, -4}, Vec3{5, 8, -4}, Vec3{5, 8, 8}};
  const Corners behind{Vec3{-5, -4, -4}, Vec3{-5, 4, -4}, Vec3{-5, 0, 8}};
  const std::vector<Corners> others(3, {Vec3{10, 1, 1}, Vec3{10, -1, 1}, Vec3{10, 0, -1}});
  const EndStreams ends(others, 0);
  const SegmentStart start(a[0], a[1], a[2], 10);
  for (const float tolerance : {0.0F, 0x1p-10F}) {
    std::array<float, most_siblings> least{};
    least.fill(start.least_distance(others[0][0], double{tolerance}));
    on_each_instruction_set([&] {
      const auto& kernels = kernel::active_kernels().siblings;
      const auto found = [&](const Corners& triangle) {
        return kernels.segments_through(kernel::seen_triangle(start.point(), triangle, 10), ends.stream, least.data(),
                                        3, 5);
      };
      EXPECT_EQ(found(between), 5U);
      EXPECT_EQ(found({between[0], between[2], between[1]}), 5U);
      EXPECT_EQ(found(beside), 0U);
      EXPECT_EQ(found(behind), 0U);
    });
  }
}

TEST(DeepSegments, NeedMoreDistanceTheLargerTheToleranceIs) {
  const SegmentStart start({0, -1, -1}, {0, 1, -1}, {0, 0, 1}, 10);
  const Vec3 end{10, 0, 0};
  EXPECT_LT(start.least_distance(end, 0), 1e-9F);
  // r = 1 / √5 − …: least about √3 t · 10 · 20 / (r · 10).
  EXPECT_GT(start.least_distance(end, 0.01), 0.01F * 1.7F * 10);
  EXPECT_LT(start.least_distance(end, 0.01), 1);
  EXPECT_EQ(start.least_distance({0, 5, 0}, 0), INFINITY) << "in the plane of the triangle";
  const SegmentStart line({0, 0, 0}, {0, 1, 0}, {0, 2, 0}, 10);
  EXPECT_EQ(line.least_distance(end, 0), INFINITY) << "without an area";
}

}  // namespace
}  // namespace shaftcull
