// SPDX-License-Identifier: MIT
/// The orders of joining planes: by the volume they cut off, alone or beyond those before them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "oracle/random.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull {
namespace {

using testing::ElementsAre;
using testing::Pair;

bool is_beyond(const JoiningPlane& joining, const Vec3& point) {
  double v = -double{joining.plane.offset};
  for (std::size_t k = 0; k != 3; ++k) v += double{joining.plane.normal[k]} * double{point[k]};
  return v > 0;
}

/// The share of the shaft box that each plane cuts off beyond those before it, by looking at a grid of points.
std::vector<double> sampled_shares(const Shaft& shaft, std::span<const JoiningPlane> planes) {
  constexpr int steps = 40;
  std::vector<double> shares(planes.size());
  for (int i = 0; i != steps * steps * steps; ++i) {
    const int step[3] = {i % steps, i / steps % steps, i / steps / steps};
    Vec3 point{};
    for (std::size_t k = 0; k != 3; ++k) {
      const float t = (static_cast<float>(step[k]) + 0.5F) / steps;
      point[k] = shaft.box().lo[k] + t * (shaft.box().hi[k] - shaft.box().lo[k]);
    }
    const auto first = std::ranges::find_if(planes, [&](const JoiningPlane& p) { return is_beyond(p, point); });
    if (first != planes.end())
      shares[static_cast<std::size_t>(first - planes.begin())] += 1.0 / (steps * steps * steps);
  }
  return shares;
}

std::vector<std::pair<Face, Face>> edges_of(const Shaft& shaft) {
  std::vector<std::pair<Face, Face>> edges;
  for (const JoiningPlane& plane : shaft.joining_planes()) edges.emplace_back(plane.red, plane.blue);
  return edges;
}

TEST(CulledVolume, IsThatOfTheCornerPrism) {
  // In x and y: a's edge at (0, 2), b's at (3, 0). The corner (0, 0) is cut off by a triangle of 3 × 2 / 2, 5 deep.
  const Shaft shaft({{0, 2, 0}, {1, 4, 5}}, {{3, 0, 0}, {4, 1, 5}});
  const auto cuts_corner = [](const JoiningPlane& plane) { return plane.red == 0 && plane.blue == 1; };
  const auto plane = std::ranges::find_if(shaft.joining_planes(), cuts_corner);
  ASSERT_NE(plane, shaft.joining_planes().end());
  EXPECT_NEAR(culled_volume(shaft.box(), *plane), 15, 1e-5);
}

TEST(CulledVolume, CountsOnlyWhatLiesWithinTheBox) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  // x + y ≥ 1.5 is inside: the square but for a triangle of legs 0.5.
  EXPECT_NEAR(culled_volume(box, {{{-1, -1, 0}, -1.5F}, 0, 1}), 1 - 0.125, 1e-6);
  EXPECT_NEAR(culled_volume(box, {{{-1, 0, 0}, -0.25F}, 0, 1}), 0.25, 1e-6);
  EXPECT_NEAR(culled_volume(box, {{{-1, -1, 0}, -7}, 0, 1}), 1, 1e-9);
  EXPECT_EQ(culled_volume(box, {{{-1, -1, 0}, 0}, 0, 1}), 0);
}

TEST(PlaneOrder, ByVolumeHasTheLargestFirst) {
  Random random(3);
  for (int i = 0; i != 2000; ++i) {
    const Shaft shaft(random.box(-5, 5, 0.1F, 2), random.box(-5, 5, 0.1F, 2), {.order = PlaneOrder::by_volume});
    double before = INFINITY;
    for (const JoiningPlane& plane : shaft.joining_planes()) {
      const double volume = culled_volume(shaft.box(), plane);
      EXPECT_LE(volume, before * (1 + 1e-4) + 1e-4) << "seed 3, shaft " << i;
      before = volume;
    }
  }
}

TEST(PlaneOrder, ByAddedVolumeIsGreedy) {
  Random random(5);
  for (int i = 0; i != 25; ++i) {
    const Shaft shaft(random.box(-5, 5, 0.1F, 3), random.box(-5, 5, 0.1F, 3), {.order = PlaneOrder::by_added_volume});
    std::vector<JoiningPlane> planes(shaft.joining_planes().begin(), shaft.joining_planes().end());
    const std::vector<double> chosen = sampled_shares(shaft, planes);
    for (std::size_t rank = 0; rank < planes.size(); ++rank) {
      for (std::size_t other = rank + 1; other < planes.size(); ++other) {
        std::vector<JoiningPlane> instead = planes;
        std::swap(instead[rank], instead[other]);
        EXPECT_LE(sampled_shares(shaft, instead)[rank], chosen[rank] + 0.01)
            << "seed 5, shaft " << i << ": plane " << other << " adds more than plane " << rank;
      }
    }
  }
}

TEST(PlaneOrder, ByAddedVolumePairsDiagonalPlanesBeforeLargerOnesThatOverlap) {
  // Boxes in opposite corners. Edges in z cut most; the diagonal pair of them (lo x, hi y) and (hi x, lo y) never
  // overlaps. Between them in volume are prisms that overlap the first.
  const Box a{{0, 0, 0}, {1, 1, 1}};
  const Box b{{9, 8, 7}, {10, 10, 10}};
  const Shaft sorted(a, b, {.order = PlaneOrder::by_volume});
  const Shaft greedy(a, b, {.order = PlaneOrder::by_added_volume});
  ASSERT_EQ(greedy.joining_planes().size(), 6U);
  EXPECT_EQ(edges_of(greedy)[0], edges_of(sorted)[0]);
  const auto axes = [](const JoiningPlane& p) { return p.red % 3 + p.blue % 3; };
  EXPECT_EQ(axes(greedy.joining_planes()[0]), axes(greedy.joining_planes()[1]));
  EXPECT_NE(axes(sorted.joining_planes()[0]), axes(sorted.joining_planes()[1]));
}

TEST(PlaneOrder, NeverAddsOrDropsAPlane) {
  Random random(13);
  for (int i = 0; i != 2000; ++i) {
    const bool on_grid = i % 2 == 0;
    const Box a = on_grid ? random.grid_box(-3, 3) : random.box(-5, 5, 0.1F, 2);
    const Box b = on_grid ? random.grid_box(-3, 3) : random.box(-5, 5, 0.1F, 2);
    std::vector<std::pair<Face, Face>> unsorted = edges_of(Shaft(a, b));
    std::ranges::sort(unsorted);
    for (const PlaneOrder order : {PlaneOrder::by_volume, PlaneOrder::by_added_volume}) {
      std::vector<std::pair<Face, Face>> edges = edges_of(Shaft(a, b, {.order = order}));
      std::ranges::sort(edges);
      EXPECT_EQ(edges, unsorted) << "seed 13, shaft " << i;
    }
  }
}

TEST(PlaneOrder, KeepsTheUnsortedOrderOfEqualVolumes) {
  // Cubes in opposite corners of a cube: all six planes cut the same.
  const Box a{{0, 0, 0}, {1, 1, 1}};
  const Box b{{2, 2, 2}, {3, 3, 3}};
  const Shaft unsorted(a, b);
  EXPECT_EQ(edges_of(Shaft(a, b, {.order = PlaneOrder::by_volume})), edges_of(unsorted));
}

TEST(PlaneOrder, OfAFlatShaftIsByArea) {
  // In the plane z = 0, so that every volume is 0.
  const Box a{{0, 4, 0}, {1, 5, 0}};
  const Box b{{6, 0, 0}, {10, 1, 0}};
  for (const PlaneOrder order : {PlaneOrder::by_volume, PlaneOrder::by_added_volume}) {
    const Shaft shaft(a, b, {.order = order});
    // The corner (10, 5) loses 9 × 4 / 2, the corner (0, 0) 6 × 4 / 2.
    EXPECT_THAT(edges_of(shaft), ElementsAre(Pair(4, 3), Pair(0, 1)));
  }
}

}  // namespace
}  // namespace shaftcull
