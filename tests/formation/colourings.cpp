// SPDX-License-Identifier: MIT
/// All 729 colourings of the shaft box's faces: the tables, the search and the planes they make.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include "formation/rule.hpp"
#include "formation/search.hpp"
#include "formation/table.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull {
namespace {

using kernel::Colour;
using kernel::Colouring;
using kernel::table729;

struct Pair {
  Box a;
  Box b;
};

/// Boxes whose shaft box has the colours `colouring`.
Pair boxes_coloured(const Colouring& colouring) {
  Pair pair{};
  for (std::size_t k = 0; k != 3; ++k) {
    const auto inset = [&](std::size_t face, Colour colour) { return colouring[face] == colour ? 1.0F : 0.0F; };
    pair.a.lo[k] = -4.0F + inset(k, Colour::blue);
    pair.b.lo[k] = -4.0F + 2 * inset(k, Colour::red);
    pair.a.hi[k] = 5.0F - inset(k + 3, Colour::blue);
    pair.b.hi[k] = 5.0F - 3 * inset(k + 3, Colour::red);
  }
  return pair;
}

using PlaneKey = std::tuple<Face, Face, float, float, float, float>;

std::vector<PlaneKey> planes_of(const Shaft& shaft) {
  std::vector<PlaneKey> keys;
  for (const JoiningPlane& joining : shaft.joining_planes()) {
    const Plane& plane = joining.plane;
    keys.emplace_back(joining.red, joining.blue, plane.normal[0], plane.normal[1], plane.normal[2], plane.offset);
  }
  return keys;
}

TEST(Colouring, OfEveryKindIsThatOfSomePairOfBoxes) {
  for (std::size_t row = 0; row != table729.size; ++row) {
    const Colouring colouring = table729.colouring_of(row);
    const Pair pair = boxes_coloured(colouring);
    EXPECT_EQ(kernel::colours(kernel::positions(pair.a), kernel::positions(pair.b)), colouring) << "row " << row;
  }
}

TEST(Colouring, GivesTheSamePlanesByEveryMethodOfFormation) {
  for (std::size_t row = 0; row != table729.size; ++row) {
    const Pair pair = boxes_coloured(table729.colouring_of(row));
    const auto form = [&](Formation formation) { return planes_of(Shaft(pair.a, pair.b, {.formation = formation})); };
    const std::vector<PlaneKey> planes = form(Formation::search);
    EXPECT_EQ(form(Formation::table64), planes) << "row " << row;
    EXPECT_EQ(form(Formation::table729), planes) << "row " << row;
  }
}

TEST(Colouring, MakesAPlaneForEachEdgeBetweenRedAndBlueAndForNoOther) {
  for (std::size_t row = 0; row != table729.size; ++row) {
    const Colouring colouring = table729.colouring_of(row);
    const Pair pair = boxes_coloured(colouring);
    const Shaft shaft(pair.a, pair.b);
    std::size_t edges = 0;
    for (Face red = 0; red != 6; ++red) {
      for (Face blue = 0; blue != 6; ++blue) {
        if (colouring[red] != Colour::red || colouring[blue] != Colour::blue || red % 3 == blue % 3) continue;
        ++edges;
        const auto joins = [&](const JoiningPlane& plane) { return plane.red == red && plane.blue == blue; };
        EXPECT_EQ(std::ranges::count_if(shaft.joining_planes(), joins), 1) << "row " << row;
      }
    }
    EXPECT_EQ(shaft.joining_planes().size(), edges) << "row " << row;
    EXPECT_LE(edges, max_joining_planes);
  }
}

TEST(Colouring, MakesPlanesThatContainBothBoxesAndTouchBoth) {
  for (std::size_t row = 0; row != table729.size; ++row) {
    const Pair pair = boxes_coloured(table729.colouring_of(row));
    const Shaft shaft = Shaft(pair.a, pair.b);
    for (const JoiningPlane& joining : shaft.joining_planes()) {
      const Plane& plane = joining.plane;
      const auto farthest = [&](const Box& box) {
        double distance = -plane.offset;
        for (std::size_t k = 0; k != 3; ++k) {
          const double n = plane.normal[k];
          distance += std::max(n * box.lo[k], n * box.hi[k]);
        }
        return distance;
      };
      EXPECT_NEAR(farthest(pair.a), 0, 2e-6) << "row " << row;
      EXPECT_NEAR(farthest(pair.b), 0, 2e-6) << "row " << row;
      EXPECT_EQ(plane.normal[3U - joining.red % 3U - joining.blue % 3U], 0) << "row " << row;
    }
  }
}

TEST(Colouring, SwapsRedAndBlueWithTheBoxes) {
  for (std::size_t row = 0; row != table729.size; ++row) {
    const Pair pair = boxes_coloured(table729.colouring_of(row));
    std::vector<PlaneKey> planes = planes_of(Shaft(pair.a, pair.b));
    std::vector<PlaneKey> swapped = planes_of(Shaft(pair.b, pair.a));
    for (PlaneKey& key : swapped) std::swap(std::get<0>(key), std::get<1>(key));
    ASSERT_EQ(swapped.size(), planes.size()) << "row " << row;
    std::ranges::sort(planes);
    std::ranges::sort(swapped);
    for (std::size_t i = 0; i != planes.size(); ++i) {
      EXPECT_EQ(std::get<0>(swapped[i]), std::get<0>(planes[i])) << "row " << row;
      EXPECT_EQ(std::get<1>(swapped[i]), std::get<1>(planes[i])) << "row " << row;
      EXPECT_NEAR(std::get<5>(swapped[i]), std::get<5>(planes[i]), 1e-5) << "row " << row;
    }
  }
}

}  // namespace
}  // namespace shaftcull
