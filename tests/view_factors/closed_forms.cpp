// SPDX-License-Identifier: MIT
/// View factors that are known in closed form, and published values.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "shaftcull/view_factors.hpp"

namespace shaftcull {
namespace {

using Corners = std::vector<Vec3>;
using std::numbers::pi;

constexpr double promised = 1e-8;  // of the factor

/// A rectangle from the origin along x and y, at a height, that faces up or down.
Corners rectangle(float x, float y, float z, bool faces_up) {
  Corners corners{{0, 0, z}, {x, 0, z}, {x, y, z}, {0, y, z}};
  if (!faces_up) std::swap(corners[1], corners[3]);
  return corners;
}

/// Two equal rectangles at a distance, opposite to each other; sides by the distance. J. R. Howell's catalogue, C-11.
double of_parallel(double x, double y) {
  const double root_x = std::sqrt(1 + x * x);
  const double root_y = std::sqrt(1 + y * y);
  return 2 / (pi * x * y) *
         (std::log(root_x * root_y / std::sqrt(1 + x * x + y * y)) + x * root_y * std::atan(x / root_y) +
          y * root_x * std::atan(y / root_x) - x * std::atan(x) - y * std::atan(y));
}

/// From a rectangle to one across it, with a common edge; width and height by its length. Likewise, C-14.
double of_perpendicular(double width, double height) {
  const double w = width * width;
  const double h = height * height;
  const double root = std::sqrt(h + w);
  const double logarithms = std::log((1 + w) * (1 + h) / (1 + w + h)) +
                            w * std::log(w * (1 + w + h) / ((1 + w) * (w + h))) +
                            h * std::log(h * (1 + h + w) / ((1 + h) * (h + w)));
  return (width * std::atan(1 / width) + height * std::atan(1 / height) - root * std::atan(1 / root) + logarithms / 4) /
         (pi * width);
}

TEST(ViewFactorInClosedForm, OfOppositeRectangles) {
  for (const auto& [x, y, distance] : std::vector<Vec3>{
           {1, 1, 1}, {1, 1, 0.125F}, {1, 1, 4}, {5, 0.25F, 1}, {2, 3, 0.5F}, {1, 1, 0x1p-10F}, {1, 8, 16}}) {
    const double right = of_parallel(double{x} / distance, double{y} / distance);
    const double found = view_factor(rectangle(x, y, 0, true), rectangle(x, y, distance, false));
    EXPECT_NEAR(found / right, 1, promised) << x << ", " << y << ", " << distance;
  }
}

TEST(ViewFactorInClosedForm, OfRectanglesWithACommonEdge) {
  for (const auto& [width, height, length] :
       std::vector<Vec3>{{1, 1, 1}, {1, 0.125F, 1}, {1, 5, 1}, {1, 1, 20}, {1, 0x1p-10F, 1}, {3, 2, 0.5F}}) {
    const double right = of_perpendicular(double{width} / length, double{height} / length);
    const Corners floor{{0, 0, 0}, {width, 0, 0}, {width, length, 0}, {0, length, 0}};
    const Corners wall{{0, 0, 0}, {0, length, 0}, {0, length, height}, {0, 0, height}};
    EXPECT_NEAR(view_factor(floor, wall) / right, 1, promised) << width << ", " << height << ", " << length;
  }
}

/// From a pentagon to a square across it, with a common edge: the value is published, to seven digits.
TEST(ViewFactorInClosedForm, OfASquareAndAPentagonIsThePublishedOne) {
  const Corners pentagon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5F, 2, 0}, {0, 1, 0}};
  const Corners square{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  EXPECT_NEAR(view_factor(pentagon, square), 0.1541243, 5e-8);
  EXPECT_NEAR(view_factor(square, pentagon), 1.5 * 0.1541243, 8e-8);  // by the ratio of areas
}

/// Two long strips with a common edge and an angle between them: crossed strings, (1 + 1 − third side) / 2, if they
/// were endless. Ends of strips that are 4,000 wide take 1 / 4,000 of it or so.
TEST(ViewFactorInClosedForm, OfLongStripsIsThatOfCrossedStrings) {
  constexpr float half = 2000;
  for (const double angle : {0.1, 0.5, 1.5, 2.5, 3.0}) {
    const auto x = static_cast<float>(std::cos(angle));
    const auto z = static_cast<float>(std::sin(angle));
    const Corners strip{{0, -half, 0}, {1, -half, 0}, {1, half, 0}, {0, half, 0}};
    const Corners other{{0, -half, 0}, {0, half, 0}, {x, half, z}, {x, -half, z}};
    EXPECT_NEAR(view_factor(strip, other) / (1 - std::sin(angle / 2)), 1, 2.0 / half) << angle;
  }
}

/// Small polygons that face each other: area by π times the square of the distance.
TEST(ViewFactorInClosedForm, OfPolygonsThatAreFarAwayIsThatOfPoints) {
  for (const float distance : {0x1p6F, 0x1p10F, 0x1p20F, 0x1p60F}) {
    const double right = 1 / (pi * double{distance} * double{distance});
    const double found = view_factor(rectangle(1, 1, 0, true), rectangle(1, 1, distance, false));
    const double of_size = 2 / (double{distance} * double{distance});  // what their size makes of it
    EXPECT_NEAR(found / right, 1, promised + of_size) << distance;
  }
}

// Every compiler and processor has these bits.
TEST(ViewFactor, OfACubeHasTheBitsOnRecord) {
  const Corners floor = rectangle(1, 1, 0, true);
  const Corners wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const Corners triangle{{0.25F, 0.125F, 3}, {0.5F, 2.5F, 1}, {0.75F, -1.5F, 1.25F}};
  EXPECT_EQ(view_factor(floor, rectangle(1, 1, 1, false)), 0x1.993dcb7f9b9fbp-3);
  EXPECT_EQ(view_factor(floor, rectangle(1, 1, 16, false)), 0x1.451a723049bfdp-10);
  EXPECT_EQ(view_factor(floor, wall), 0x1.99b08d2019306p-3);
  EXPECT_EQ(view_factor(triangle, floor), 0x1.10d435ed72074p-6);
}

}  // namespace
}  // namespace shaftcull
