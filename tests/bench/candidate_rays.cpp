// SPDX-License-Identifier: MIT
// Rays against boxes, on each instruction set that they are compiled for, against a plain test in double precision.
#include "families/candidate_rays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/city_blocks.hpp"
#include "scenes/interior.hpp"
#include "scenes/patch_pairs.hpp"
#include "scenes/random.hpp"

namespace shaftcull::bench {
namespace {

using Point = std::array<double, 3>;

Point end_of(const Patch& patch, const ShadowRays& rays, std::size_t which, unsigned i) {
  const ShadowRays::Points& points = patch.triangle ? rays.on_triangle[which] : rays.on_rectangle[which];
  Point p{};
  for (std::size_t k = 0; k != 3; ++k) {
    p[k] = static_cast<double>(patch.corner[k]) +
           static_cast<double>(points[0][i]) * static_cast<double>(patch.across[k]) +
           static_cast<double>(points[1][i]) * static_cast<double>(patch.up[k]);
  }
  return p;
}

/// How deep a ray goes into a box whose sides are moved outwards by `grown`: above 0 if it meets it, in shares of its
/// length.
double part_inside(const RayBox& box, const Point& from, const Point& to, double grown) {
  const auto turned = [&box](const Point& p) {
    const double x = p[0] - static_cast<double>(box.centre[0]);
    const double y = p[1] - static_cast<double>(box.centre[1]);
    const auto c = static_cast<double>(box.cosine);
    const auto s = static_cast<double>(box.sine);
    return Point{c * x + s * y, c * y - s * x, p[2] - static_cast<double>(box.centre[2])};
  };
  const Point start = turned(from);
  const Point end = turned(to);
  double first = static_cast<double>(ray_margin);
  double last = 1 - first;
  for (std::size_t k = 0; k != 3; ++k) {
    const double half = static_cast<double>(box.half[k]) + grown;
    const double step = end[k] - start[k];
    if (step == 0) {
      if (std::abs(start[k]) >= half) return -1;
      continue;
    }
    const double one = (-half - start[k]) / step;
    const double other = (half - start[k]) / step;
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return last - first;
}

class Rays : public testing::TestWithParam<Isa> {
 protected:
  void SetUp() override {
    const std::vector<Isa> available = available_isas();
    if (trace == nullptr || std::find(available.begin(), available.end(), GetParam()) == available.end()) {
      GTEST_SKIP() << "this build or this machine does not have it";
    }
  }
  TraceCandidates* const trace = trace_candidates(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Of, Rays, testing::Values(Isa::avx2, Isa::avx512),
                         [](const auto& isa) { return std::string(shaftcull::name(isa.param)); });

TEST_P(Rays, AreCountedAsAPlainTestCountsThem) {
  for (const bool city : {false, true}) {
    const PatchScene scene = city ? city_blocks({30}) : interior({1.5F});
    const std::vector<RayBox> boxes = ray_boxes_of(scene);
    ASSERT_EQ(boxes.size() + 1, scene.objects.size());
    const double rounding = city ? 1e-2 : 1e-4;
    Random random(7);
    std::uint64_t checked = 0;
    std::uint64_t met = 0;
    std::uint64_t maybes = 0;
    for (int pair = 0; pair != 300; ++pair) {
      const std::uint32_t a = random.below(static_cast<unsigned>(scene.patches.size()));
      const std::uint32_t b = random.below(static_cast<unsigned>(scene.patches.size()));
      const RayEnds ends{scene.patches[a], scene.patches[b], scene.patch_planes[a], scene.patch_planes[b]};
      std::vector<std::uint32_t> candidates;
      for (int n = 0; n != 40; ++n) {
        const std::uint32_t last = n % 4 == 0 ? 1U : 0U;  // meshes are few, and last
        const std::uint32_t any = random.below(static_cast<unsigned>(boxes.size()));
        candidates.push_back(last != 0 ? static_cast<std::uint32_t>(boxes.size()) - 1 - any % 40 : any);
      }
      const ShadowRays rays(64);
      std::uint64_t maybe = 0;
      const CandidateCounts counts = trace(ends, rays, boxes, candidates, &maybe);
      unsigned least_clear = 0;
      unsigned most_clear = 0;
      unsigned traced = 0;
      for (unsigned i = 0; i != 64; ++i) {
        const Point from = end_of(ends.a, rays, 0, i);
        const Point to = end_of(ends.b, rays, 1, i);
        const auto height = [](const Plane& plane, const Point& p) {
          return static_cast<double>(plane.normal[0]) * p[0] + static_cast<double>(plane.normal[1]) * p[1] +
                 static_cast<double>(plane.normal[2]) * p[2] - static_cast<double>(plane.offset);
        };
        const double rise = std::min(height(ends.plane_a, to), height(ends.plane_b, from));
        if (std::abs(rise) < rounding) {  // which side it is on is a matter of rounding
          ++most_clear;
          continue;
        }
        if (rise < 0) continue;
        ++traced;
        const auto meets = [&](bool solid, double grown) {
          return std::any_of(candidates.begin(), candidates.end(), [&](std::uint32_t candidate) {
            return boxes[candidate].solid == solid && part_inside(boxes[candidate], from, to, grown) > 0;
          });
        };
        if (!meets(true, rounding) && !meets(false, rounding)) ++least_clear;
        if (!meets(true, -rounding) && !meets(false, -rounding)) ++most_clear;
        if ((maybe >> i & 1U) != 0) {
          EXPECT_FALSE(meets(true, -rounding)) << "pair " << a << ", " << b << ", ray " << i;
          EXPECT_TRUE(meets(false, rounding)) << "pair " << a << ", " << b << ", ray " << i;
        }
        met += meets(true, -rounding) ? 1U : 0U;
      }
      EXPECT_GE(counts.traced, traced);
      EXPECT_GE(counts.clear, least_clear) << "pair " << a << ", " << b;
      EXPECT_LE(counts.clear, most_clear) << "pair " << a << ", " << b;
      EXPECT_EQ(counts.maybe, static_cast<unsigned>(std::popcount(maybe)));
      checked += traced;
      maybes += counts.maybe;
    }
    // All kinds of rays were there.
    EXPECT_GT(checked, 1000U);
    EXPECT_GT(met, 50U);
    EXPECT_EQ(maybes > 0, !city);
  }
}

TEST_P(Rays, PastNoBoxAreClear) {
  const PatchScene scene = interior({1.5F});
  const RayEnds ends{scene.patches[0], scene.patches[1], {{0, 0, 0}, -1}, {{0, 0, 0}, -1}};
  std::uint64_t maybe = 0;
  const CandidateCounts counts = trace(ends, ShadowRays(16), {}, {}, &maybe);
  EXPECT_EQ(counts.traced, 16U);
  EXPECT_EQ(counts.clear, 16U);
  EXPECT_EQ(counts.maybe, 0U);
}

}  // namespace
}  // namespace shaftcull::bench
