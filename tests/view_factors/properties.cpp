// SPDX-License-Identifier: MIT
/// What is true of all view factors, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "message_of.hpp"
#include "oracle/random.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/view_factors.hpp"

namespace shaftcull {
namespace {

using Corners = std::vector<Vec3>;

/// Six sides of a box, each cut into n × n, which face inwards.
std::vector<Corners> room(const Vec3& size, std::size_t n) {
  std::vector<Corners> patches;
  for (unsigned axis = 0; axis != 3; ++axis) {
    const unsigned u = (axis + 1) % 3;
    const unsigned v = (axis + 2) % 3;
    for (const bool is_far : {false, true}) {
      for (std::size_t i = 0; i != n * n; ++i) {
        const std::size_t column = i % n;
        const std::size_t row = i / n;
        Corners patch;
        for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          Vec3 corner{};
          corner[axis] = is_far ? size[axis] : 0;
          corner[u] = size[u] * static_cast<float>(column + p) / static_cast<float>(n);
          corner[v] = size[v] * static_cast<float>(row + q) / static_cast<float>(n);
          patch.push_back(corner);
        }
        if (is_far) std::reverse(patch.begin(), patch.end());
        patches.push_back(patch);
      }
    }
  }
  return patches;
}

Vec3 turned(const Vec3& p, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const double x = cosine * p[0] - sine * p[1];
  const double y = sine * p[0] + cosine * p[1];
  return {static_cast<float>(x), static_cast<float>(cosine * y - sine * p[2]),
          static_cast<float>(sine * y + cosine * p[2])};
}

double area(const Corners& corners) {
  double normal[3] = {};
  for (std::size_t i = 2; i < corners.size(); ++i) {
    for (unsigned k = 0; k != 3; ++k) {
      const unsigned u = (k + 1) % 3;
      const unsigned v = (k + 2) % 3;
      normal[k] += (double{corners[i - 1][u]} - corners[0][u]) * (double{corners[i][v]} - corners[0][v]) -
                   (double{corners[i - 1][v]} - corners[0][v]) * (double{corners[i][u]} - corners[0][u]);
    }
  }
  return std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]) / 2;
}

/// The definition, with a point in the middle of each of m² similar triangles of both.
double by_points(const Corners& from, const Corners& to, int m) {
  struct Sample {
    double at[3];
  };
  const auto samples_of = [m](const Corners& triangle) {
    std::vector<Sample> samples;
    for (int i = 0; i != m; ++i) {
      for (int j = 0; j + i < m; ++j) {
        for (const double third : {1.0 / 3, 2.0 / 3}) {
          if (third > 0.5 && i + j + 1 >= m) continue;
          const double u = (i + third) / m;
          const double v = (j + third) / m;
          Sample sample{};
          for (unsigned k = 0; k != 3; ++k) {
            sample.at[k] = triangle[0][k] + u * (double{triangle[1][k]} - triangle[0][k]) +
                           v * (double{triangle[2][k]} - triangle[0][k]);
          }
          samples.push_back(sample);
        }
      }
    }
    return samples;
  };
  const auto normal_of = [](const Corners& triangle) {
    Sample normal{};
    for (unsigned k = 0; k != 3; ++k) {
      const unsigned u = (k + 1) % 3;
      const unsigned v = (k + 2) % 3;
      normal.at[k] = (double{triangle[1][u]} - triangle[0][u]) * (double{triangle[2][v]} - triangle[0][v]) -
                     (double{triangle[1][v]} - triangle[0][v]) * (double{triangle[2][u]} - triangle[0][u]);
    }
    return normal;
  };
  const Sample normal_from = normal_of(from);
  const Sample normal_to = normal_of(to);
  const std::vector<Sample> starts = samples_of(from);
  const std::vector<Sample> ends = samples_of(to);
  double sum = 0;
  for (const Sample& p : starts) {
    for (const Sample& q : ends) {
      double square = 0;
      double leaving = 0;
      double arriving = 0;
      for (unsigned k = 0; k != 3; ++k) {
        const double way = q.at[k] - p.at[k];
        square += way * way;
        leaving += way * normal_from.at[k];
        arriving -= way * normal_to.at[k];
      }
      if (leaving > 0 && arriving > 0) sum += leaving * arriving / (square * square);
    }
  }
  return sum / (std::numbers::pi * static_cast<double>(starts.size() * ends.size()) * 4 * area(from));
}

TEST(ViewFactor, SumsToOneInAClosedRoomHoweverItIsTurned) {
  for (const double angle : {0.0, 0.7}) {
    for (const Vec3& size : {Vec3{1, 1, 1}, Vec3{4, 3, 2.5F}, Vec3{1, 1, 0.01F}}) {
      std::vector<Corners> patches = room(size, 3);
      for (Corners& patch : patches) {
        for (Vec3& corner : patch) corner = turned(corner, angle);
      }
      for (const Corners& from : patches) {
        double sum = 0;
        for (const Corners& to : patches) sum += view_factor(from, to);
        EXPECT_NEAR(sum, 1, angle == 0 ? 1e-9 : 1e-5);  // turned corners are rounded
      }
    }
  }
}

TEST(ViewFactor, IsOneExchangeByTheAreaOfEither) {
  Random random(51);
  for (int i = 0; i != 300; ++i) {
    const Corners a{random.vec3(-1, 1), random.vec3(-1, 1), random.vec3(-1, 1)};
    const Corners b{random.vec3(-1, 2), random.vec3(-1, 2), random.vec3(-1, 2)};
    const double there = view_factor(a, b);
    EXPECT_GE(there, 0);
    EXPECT_LE(there, 1);
    EXPECT_NEAR(there * area(a), view_factor(b, a) * area(b), 1e-15 * area(a));
  }
}

TEST(ViewFactor, IsThatOfTheDefinition) {
  Random random(52);
  int seen = 0;
  for (int i = 0; i != 40; ++i) {
    const Corners a{random.vec3(-1, 1), random.vec3(-1, 1), random.vec3(-1, 1)};
    Corners b{random.vec3(-1, 1), random.vec3(-1, 1), random.vec3(-1, 1)};
    for (Vec3& corner : b) corner[2] += 4;
    const double right = by_points(a, b, 24);
    const double found = view_factor(a, b);
    EXPECT_NEAR(found, right, 2e-3 * right + 1e-6) << "case " << i;
    if (right > 1e-4) ++seen;
  }
  EXPECT_GE(seen, 8);
}

TEST(ViewFactor, OfPartsSumsToThatOfTheWhole) {
  Random random(53);
  for (int i = 0; i != 100; ++i) {
    const Corners a{random.vec3(-1, 1), random.vec3(-1, 1), random.vec3(-1, 1)};
    const Corners whole{{0, 0, 2}, {0, 2, 2}, {2, 2, 2}, {2, 0, 2}};
    const Corners left{{0, 0, 2}, {0, 2, 2}, {0.5F, 2, 2}, {0.5F, 0, 2}};
    const Corners right{{0.5F, 0, 2}, {0.5F, 2, 2}, {2, 2, 2}, {2, 0, 2}};
    EXPECT_NEAR(view_factor(a, left) + view_factor(a, right), view_factor(a, whole), 1e-10);
  }
}

TEST(ViewFactor, DoesNotCountWhatIsBehindAPlane) {
  const Corners wide{{-1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}};
  const Corners high{{0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1}};
  const Corners floor{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Corners wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  EXPECT_NEAR(view_factor(wide, high), view_factor(floor, wall) / 2, 1e-12);
  const Corners below{{0, 0, -2}, {1, 0, -2}, {1, 1, -2}, {0, 1, -2}};
  EXPECT_EQ(view_factor(floor, below), 0);
  EXPECT_EQ(view_factor(below, floor), 0);
  EXPECT_EQ(view_factor(floor, floor), 0);
  const Corners beside{{3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3, 1, 0}};
  EXPECT_EQ(view_factor(floor, beside), 0);
}

TEST(ViewFactor, IsThatOfTheSameScaleAnywhere) {
  const Corners floor{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Corners wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const double right = view_factor(floor, wall);
  for (const float scale : {0x1p-120F, 0x1p-20F, 0x1p100F}) {
    Corners scaled_floor = floor;
    Corners scaled_wall = wall;
    for (Corners* const corners : {&scaled_floor, &scaled_wall}) {
      for (Vec3& corner : *corners) {
        for (float& x : corner) x *= scale;
      }
    }
    EXPECT_EQ(view_factor(scaled_floor, scaled_wall), right) << scale;
  }
}

TEST(ViewFactor, TakesAnyConvexPolygon) {
  // A prism of eight sides is closed.
  Corners round;
  for (int i = 0; i != 8; ++i) {
    const double angle = i * std::numbers::pi / 4;
    round.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
  }
  Corners lid;
  for (const Vec3& corner : round) lid.push_back({corner[0], corner[1], 1});
  std::reverse(lid.begin(), lid.end());
  double sum = view_factor(round, lid);
  for (std::size_t i = 0; i != 8; ++i) {
    const Vec3& p = round[i];
    const Vec3& q = round[(i + 1) % 8];
    sum += view_factor(round, Corners{q, p, {p[0], p[1], 1}, {q[0], q[1], 1}});
  }
  EXPECT_NEAR(sum, 1, 1e-6);
  const Corners triangle{{0, 0, 3}, {0, 1, 3}, {1, 0, 3}};
  const Corners repeated{{0, 0, 3}, {0, 1, 3}, {0, 1, 3}, {1, 0, 3}};
  EXPECT_NEAR(view_factor(round, triangle), view_factor(round, repeated), 1e-11);
  EXPECT_EQ(view_factor(round, Corners{{0, 0, 3}, {0, 1, 3}, {0, 2, 3}}), 0) << "a polygon without area";
}

TEST(ViewFactor, TakesCornersThatAreThereTwice) {
  const Corners floor{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Corners wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const double right = view_factor(floor, wall);
  for (std::size_t i = 0; i != 4; ++i) {
    for (std::size_t j = 0; j != 4; ++j) {
      Corners twice_wall = wall;
      Corners twice_floor = floor;
      twice_wall.insert(twice_wall.begin() + static_cast<std::ptrdiff_t>(i), wall[i]);
      twice_floor.insert(twice_floor.begin() + static_cast<std::ptrdiff_t>(j), floor[j]);
      EXPECT_NEAR(view_factor(floor, twice_wall), right, 1e-9);
      EXPECT_NEAR(view_factor(twice_floor, twice_wall), right, 1e-9);
      EXPECT_NEAR(view_factor(twice_wall, twice_floor), right, 1e-9);
    }
  }
}

// A sensor above the ground: the closed form of a small patch opposite to the middle of a rectangle.
TEST(ViewFactor, OfASmallPolygonNearALargeOneKeepsItsDigits) {
  for (const float size : {1.0F, 0.1F, 0.01F, 0.001F, 0.0001F}) {
    for (const float side : {10.0F, 1000.0F}) {
      const float half = side / 2;
      for (const float height : {1.0F, 3.0F}) {
        const Corners ground{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
        const Corners sensor{
            {-size, -size, height}, {-size, size, height}, {size, size, height}, {size, -size, height}};
        const double x = double{half} / height;
        const double root = std::sqrt(1 + x * x);
        const double right = 4 * x / root * std::atan(x / root) / std::numbers::pi;
        EXPECT_NEAR(view_factor(sensor, ground), right, 1e-8 + size * size) << size << ", " << side << ", " << height;
      }
    }
  }
}

TEST(ViewFactor, SaysWhatItRefuses) {
  const Corners square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto message = [&](const Corners& from, const Corners& to) {
    return message_of([&] { static_cast<void>(view_factor(from, to)); });
  };
  EXPECT_EQ(message(Corners(2), square), "polygon \"from\" has 2 corners; a view factor takes 3 to 8");
  EXPECT_EQ(message(square, Corners(9)), "polygon \"to\" has 9 corners; a view factor takes 3 to 8");
  EXPECT_EQ(message(Corners(3), square), "polygon \"from\" has no area");
  Corners broken = square;
  broken[2][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message(square, broken), "corner 2 of polygon \"to\" is not finite");
  EXPECT_THROW(static_cast<void>(view_factor(std::span<const Vec3>(static_cast<const Vec3*>(nullptr), 4), square)),
               InvalidArgument);
}

}  // namespace
}  // namespace shaftcull
