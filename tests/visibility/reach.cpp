// SPDX-License-Identifier: MIT
/// Which occluders reach between two patches, in lanes: what is certain there is what exact planes say.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "corners_in_lanes.hpp"
#include "dispatch/active_kernels.hpp"
#include "exact/patch_plane.hpp"
#include "exact/tangent_planes.hpp"
#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "visibility/patch_edges.hpp"

namespace shaftcull {
namespace {

using kernel::CornersOfPairs;
using kernel::most_siblings;
using kernel::PatchEdges;
using kernel::PointsBetween;

/// Patches and points with coordinates that are small integers times a factor, some of them moved to the next float.
class Scene {
 public:
  explicit Scene(std::uint64_t seed) : random_(seed) {
    constexpr float factors[] = {1, 0.37F, 0x1p-20F, 1e6F, 0x1p-100F, 0x1p60F};
    factor_ = factors[random_.below(6)];
    offset_ = random_.one_in(4) ? 1e4F : 0;
    has_boxes_ = random_.one_in(4);
    corners_ = has_boxes_ ? 8 : some_corners();
  }
  [[nodiscard]] Random& random() { return random_; }
  /// Of a polygon. Most have few: of more, exact planes decide slowly, and fewer points are behind one of them.
  [[nodiscard]] unsigned some_corners() {
    return random_.one_in(4) ? 3 + static_cast<unsigned>(random_.below(6))
                             : 3 + static_cast<unsigned>(random_.below(2));
  }
  [[nodiscard]] unsigned corners() const { return corners_; }
  [[nodiscard]] bool has_boxes() const { return has_boxes_; }
  [[nodiscard]] std::vector<Vec3> points(std::size_t count, int x, int reach) {
    std::vector<Vec3> points(count);
    for (Vec3& point : points) {
      for (std::size_t k = 0; k != 3; ++k) point[k] = coordinate(k == 0 ? x : 0, reach);
    }
    return points;
  }
  /// A polygon of as many corners as patches have, or fewer: then the last one is repeated. Or the corners of a box.
  [[nodiscard]] std::vector<Vec3> patch(int x) {
    if (has_boxes_) {
      const std::vector<Vec3> ends = points(2, x, 4);
      const Box box = Random::sorted(ends[0], random_.one_in(3) ? Vec3{ends[0][0], ends[1][1], ends[1][2]} : ends[1]);
      return corners_of_box_between(box.lo, box.hi);
    }
    std::vector<Vec3> corners = points(corners_, x, 5);
    if (corners_ > 3 && random_.one_in(3)) corners.back() = corners[corners_ - 2];
    return corners;
  }
  [[nodiscard]] float tolerance() {
    return random_.one_in(2) ? 0 : std::ldexp((offset_ + 64) * factor_, -6 - static_cast<int>(random_.below(19)));
  }

 private:
  [[nodiscard]] float coordinate(int middle, int reach) {
    const float at = (static_cast<float>(middle) + random_.integer(-reach, reach) + offset_) * factor_;
    return random_.one_in(4) ? random_.nudge(at) : at;
  }

  Random random_;
  float factor_ = 1;
  float offset_ = 0;
  bool has_boxes_ = false;
  unsigned corners_ = 3;
};

TEST(ReachInLanes, IsCertainOnlyOfWhatExactPlanesSay) {
  std::uint64_t reaching = 0;
  std::uint64_t separate = 0;
  for (std::uint64_t seed = 1; seed <= random_cases(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Scene scene(seed);
    // With boxes on the other side, the fixed patch is a polygon; else it may be a box.
    const bool is_fixed_box = !scene.has_boxes() && scene.random().one_in(3);
    std::vector<Vec3> fixed = scene.points(scene.some_corners(), -12, 5);
    if (is_fixed_box) fixed = distinct(corners_of_box_between(fixed[0], fixed[1]));
    std::vector<std::vector<Vec3>> others;
    while (others.size() != most_siblings) others.push_back(scene.patch(scene.random().one_in(4) ? -8 : 12));
    const CornersInLanes lanes(others, scene.corners());
    const float tolerance = scene.tolerance();
    const PatchEdges fixed_edges =
        is_fixed_box ? PatchEdges::of_box(fixed) : PatchEdges::of_polygon(static_cast<unsigned>(fixed.size()));
    const PatchEdges edges = scene.has_boxes() ? PatchEdges::of_any_box() : PatchEdges::of_polygon(scene.corners());
    const CornersOfPairs pairs{fixed.data(),       static_cast<unsigned>(fixed.size()),
                               fixed_edges.data(), fixed_edges.size(),
                               lanes.stream(),     scene.corners(),
                               edges.data(),       edges.size(),
                               most_siblings};
    ASSERT_LE(pairs.planes(), CornersOfPairs::most_planes);
    constexpr std::size_t sets = 4;
    std::array<std::vector<Vec3>, sets> points;
    std::array<std::uint64_t, sets> left_out{};
    for (std::size_t i = 0; i != sets; ++i) {
      const bool is_triangle = i < 2;
      points[i] = scene.points(is_triangle ? 3 : 1 + scene.random().below(9), 0, 11);
      for (std::size_t lane = 0; lane != most_siblings; ++lane) {
        // A polygon has its last corner once.
        std::vector<Vec3> other = scene.has_boxes() ? distinct(others[lane]) : others[lane];
        if (other.size() > 3 && other.back() == other[other.size() - 2]) other.pop_back();
        kernel::TangentPlanes planes;
        planes.begin({fixed, is_fixed_box}, {other, scene.has_boxes()});
        bool is_left_out = planes.separate({points[i], nullptr}, Contact::open, tolerance);
        if (is_triangle && !is_left_out) {
          is_left_out = kernel::are_on_one_side(fixed, other, {points[i][0], points[i][1], points[i][2]}, Contact::open,
                                                tolerance);
        }
        left_out[i] |= std::uint64_t{is_left_out} << lane;
      }
    }
    on_each_instruction_set([&] {
      const auto& kernels = kernel::active_kernels().siblings;
      const auto space = std::make_unique<kernel::ReachSpace>();
      for (const std::uint64_t asked : {~std::uint64_t{0}, std::uint64_t{0x0123456789abcdef}}) {
        for (const bool is_one_enough : {false, true}) {
          std::vector<PointsBetween> between;
          for (std::uint32_t i = 0; i != sets; ++i) {
            between.push_back({points[i].data(), static_cast<std::uint32_t>(points[i].size()), is_one_enough ? 0 : i,
                               i < 2, asked, 0, 0});
          }
          kernels.reach_between(pairs, tolerance, between.data(), between.size(), *space);
          std::uint64_t reached = 0;
          for (std::size_t i = 0; i != sets; ++i) {
            ASSERT_EQ(between[i].reaching & (left_out[i] | ~asked), 0U) << "of points " << i;
            ASSERT_EQ(between[i].separate & (~left_out[i] | ~asked), 0U) << "of points " << i;
            ASSERT_TRUE(!is_one_enough || (reached & (between[i].reaching | between[i].separate)) == 0);
            reached |= between[i].reaching;
            reaching += static_cast<std::uint64_t>(std::popcount(between[i].reaching));
            separate += static_cast<std::uint64_t>(std::popcount(between[i].separate));
          }
        }
      }
    });
    if (HasFailure()) return;
  }
  EXPECT_GT(reaching, random_cases(2000));
  EXPECT_GT(separate, random_cases(1000));
}

TEST(ReachInLanes, FindsATriangleThatReachesALittleIntoAShaft) {
  const std::vector<Vec3> fixed{{0, -1, -1}, {0, 1, -1}, {0, 0, 1}};
  const std::vector<std::vector<Vec3>> others(5, {{10, 1, -1.25F}, {10, -1, -1}, {10, 0, 1}});
  const CornersInLanes lanes(others, 3);
  const PatchEdges edges = PatchEdges::of_polygon(3);
  const CornersOfPairs pairs{fixed.data(), 3, edges.data(), 3, lanes.stream(), 3, edges.data(), 3, 5};
  const std::array<Vec3, 3> reaching{Vec3{5, -4, -4}, Vec3{5, 4, -4}, Vec3{5, 0, -0.9F}};
  const std::array<Vec3, 3> below{Vec3{5, -4, -4}, Vec3{5, 4, -4}, Vec3{5, 0, -1.2F}};
  // The box around it reaches in, and all planes that touch both patches have a corner in front.
  const std::array<Vec3, 3> beside{Vec3{-5, -8, -8}, Vec3{-5, 8, -8}, Vec3{-5, 0, 16}};
  on_each_instruction_set([&] {
    std::vector<PointsBetween> points{{below.data(), 3, 0, true, 0b10101, 0, 0},
                                      {beside.data(), 3, 1, true, 0b10101, 0, 0},
                                      {reaching.data(), 3, 2, true, 0b10101, 0, 0}};
    const auto space = std::make_unique<kernel::ReachSpace>();
    kernel::active_kernels().siblings.reach_between(pairs, 0x1p-10F, points.data(), points.size(), *space);
    EXPECT_EQ(points[0].separate, 0b10101U);
    EXPECT_EQ(points[0].reaching, 0U);
    EXPECT_EQ(points[1].separate, 0U);
    EXPECT_EQ(points[1].reaching, 0U);
    EXPECT_EQ(points[2].separate, 0U);
    EXPECT_EQ(points[2].reaching, 0b10101U);
  });
}

}  // namespace
}  // namespace shaftcull
