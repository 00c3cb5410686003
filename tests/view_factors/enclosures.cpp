// SPDX-License-Identifier: MIT
/// View factors in closed rooms and around bodies: known sums, and factors that nothing obstructs as bounds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"
#include "view_factors/radiating_scene.hpp"

namespace shaftcull {
namespace {

constexpr bool is_slow = has_shadow_memory || is_emulated || !is_optimised;

/// A sphere around the origin, of triangles with corners on it: an octahedron whose faces are cut into four, again and
/// again.
class Sphere {
 public:
  Sphere(double radius, unsigned cuts, bool inwards) : radius_(radius), inwards_(inwards) {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) {
          const bool is_left = x * y * z > 0;
          cut({x, 0, 0}, is_left ? Point{0, y, 0} : Point{0, 0, z}, is_left ? Point{0, 0, z} : Point{0, y, 0}, cuts);
        }
      }
    }
  }

  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return triangles_; }

 private:
  using Point = std::array<double, 3>;

  static Point middle(const Point& p, const Point& q) {
    const Point sum{p[0] + q[0], p[1] + q[1], p[2] + q[2]};
    const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    return {sum[0] / length, sum[1] / length, sum[2] / length};
  }

  void cut(const Point& p, const Point& q, const Point& r, unsigned cuts) {
    if (cuts == 0) {
      const auto corner = [this](const Point& x) {
        return Vec3{static_cast<float>(radius_ * x[0]), static_cast<float>(radius_ * x[1]),
                    static_cast<float>(radius_ * x[2])};
      };
      triangles_.push_back(inwards_ ? Triangle{{corner(p), corner(r), corner(q)}}
                                    : Triangle{{corner(p), corner(q), corner(r)}});
      return;
    }
    const Point pq = middle(p, q);
    const Point qr = middle(q, r);
    const Point rp = middle(r, p);
    cut(p, pq, rp, cuts - 1);
    cut(pq, q, qr, cuts - 1);
    cut(rp, qr, r, cuts - 1);
    cut(pq, qr, rp, cuts - 1);
  }

  double radius_;
  bool inwards_;
  std::vector<Triangle> triangles_;
};

// The inner sphere sees nothing but the outer one, and what both exchange is the inner one's area.
TEST(ViewFactors, OfConcentricSpheresAreTheRatioOfTheirAreas) {
  const Sphere small(1, 2, false);
  const Sphere large(2, 2, true);
  const std::size_t inner = small.triangles().size();
  std::vector<Triangle> triangles = small.triangles();
  triangles.insert(triangles.end(), large.triangles().begin(), large.triangles().end());
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (const Triangle& triangle : triangles) {
    corners.insert(corners.end(), std::begin(triangle.vertex), std::end(triangle.vertex));
    first.push_back(corners.size());
  }
  const TriangleStream stream(triangles);
  Occluders occluders;
  occluders.add_mesh(stream.view());
  const ViewFactors factors = view_factors(PatchSet(corners, first), occluders);
  std::array<double, 2> area{};
  double arriving = 0;
  double squares = 0;
  for (std::size_t i = 0; i != factors.size(); ++i) {
    area[i < inner ? 0 : 1] += factors.area[i];
    EXPECT_NEAR(factors.sum[i], 1, 2e-3) << i;
    squares += (factors.sum[i] - 1) * (factors.sum[i] - 1);
    for (std::size_t k = factors.first[i]; k != factors.first[i + 1]; ++k) {
      if (i < inner) {
        EXPECT_GE(factors.column[k], inner);
      } else if (factors.column[k] < inner) {
        arriving += factors.area[i] * factors.factor[k];
      }
    }
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(factors.size())), 3e-4);
  EXPECT_NEAR(arriving / area[1], area[0] / area[1], 1e-5);
  EXPECT_NEAR(arriving / area[1], 0.25, 1e-3);  // of real spheres
}

constexpr std::array<Vec3, 10> sizes_of_rooms{{{1, 1, 1},
                                               {6, 5, 3},
                                               {20, 3, 2.5F},
                                               {2, 2, 9},
                                               {100, 100, 4},
                                               {1, 1, 0.01F},
                                               {0.3F, 0.2F, 0.1F},
                                               {7, 1, 1},
                                               {0x1p20F, 0x1p18F, 0x1p19F},
                                               {0x1p-20F, 0x1p-21F, 0x1p-20F}}};

TEST(ViewFactors, SumToOneInTenClosedRooms) {
  for (const Vec3& size : sizes_of_rooms) {
    RadiatingScene room;
    room.add_box({{0, 0, 0}, size}, 4, true);
    const ViewFactors factors = view_factors(room.patches(), room.occluders());
    for (std::size_t i = 0; i != room.size(); ++i) EXPECT_NEAR(factors.sum[i], 1, 1e-4) << size[0] << ", patch " << i;
  }
}

TEST(ViewFactors, SumToOneAroundABoxIfManyRaysAreCast) {
  ViewFactorOptions options;
  options.rays = 65'536;
  options.error = 1e-6;
  for (const Vec3& size : std::span(sizes_of_rooms).first(4)) {
    RadiatingScene room;
    room.add_box({{0, 0, 0}, size}, 3, true);
    const auto at = [&](float part) { return Vec3{part * size[0], part * size[1], part * size[2]}; };
    room.add_box({at(0.375F), at(0.625F)}, 1, false);
    const ViewFactors factors = view_factors(room.patches(), room.occluders(), options);
    for (std::size_t i = 0; i != room.size(); ++i) EXPECT_NEAR(factors.sum[i], 1, 2e-4) << size[0] << ", patch " << i;
  }
}

TEST(ViewFactors, AreNeverAboveThoseWithoutObstacles) {
  const RadiatingScene room = furnished_room(is_slow ? 2 : 6);
  const PatchSet patches = room.patches();
  ViewFactorOptions options;
  options.error = 1e-3;
  const ViewFactors factors = view_factors(patches, room.occluders(), options);
  const ViewFactors most = view_factors(patches, {}, options);
  std::size_t smaller = 0;
  for (std::size_t i = 0; i != room.size(); ++i) {
    std::size_t k = most.first[i];
    for (std::size_t f = factors.first[i]; f != factors.first[i + 1]; ++f) {
      while (most.column[k] != factors.column[f]) ++k;  // ascends in both
      ASSERT_LE(factors.factor[f], most.factor[k]) << i << ", " << factors.column[f];
      smaller += factors.factor[f] < most.factor[k] ? 1 : 0;
    }
  }
  EXPECT_GT(factors.factor.size(), is_slow ? 10'000U : 1'000'000U);
  EXPECT_GT(smaller, factors.factor.size() / 20);
}

}  // namespace
}  // namespace shaftcull
