// SPDX-License-Identifier: MIT
// The peer counts the rays that it is asked for. Scenes here are small enough to know the answers.
#include "peers/embree.hpp"

#include <gtest/gtest.h>

#include "scenes/patch_pairs.hpp"
#include "scenes/patch_scene.hpp"
#include "scenes/shadow_rays.hpp"

namespace shaftcull::bench {
namespace {

/// A floor and a ceiling, both squares of 1, three apart; a solid is put between.
PatchScene floor_and_ceiling(const Box& between) {
  PatchSceneMaker maker({1});
  const Box floor{{0, 0, -1}, {1, 1, 0}};
  const Box ceiling{{0, 0, 3}, {1, 1, 4}};
  maker.add_box(floor);
  maker.add_box(ceiling);
  maker.add_box(between);
  maker.cut_face(floor, 2, true, 0);
  maker.cut_face(ceiling, 2, false, 0);
  return maker.take();
}

RayCounts counts_of(const PatchScene& scene, unsigned rays) {
  return EmbreeScene(scene).trace({0, 1}, ShadowRays(rays));
}

TEST(EmbreeScene, SeesThroughAnEmptyRoom) {
  const PatchScene scene = floor_and_ceiling({{5, 5, 1}, {6, 6, 2}});
  for (const unsigned rays : {4U, 8U, 16U, 64U, 256U}) {
    EXPECT_EQ(counts_of(scene, rays).traced, rays);
    EXPECT_EQ(counts_of(scene, rays).clear, rays);
  }
}

TEST(EmbreeScene, SeesNothingThroughAWall) {
  const PatchScene scene = floor_and_ceiling({{-1, -1, 1}, {2, 2, 2}});
  for (const unsigned rays : {4U, 8U, 16U, 64U, 256U}) {
    EXPECT_EQ(counts_of(scene, rays).traced, rays);
    EXPECT_EQ(counts_of(scene, rays).clear, 0U);
  }
}

TEST(EmbreeScene, SeesHalfPastAScreen) {
  // A thin one just below the ceiling hides those ends of rays that are above it.
  const PatchScene scene = floor_and_ceiling({{-1, -1, 2.98F}, {0.5F, 2, 2.99F}});
  EXPECT_EQ(counts_of(scene, 64).traced, 64U);
  EXPECT_NEAR(counts_of(scene, 64).clear, 32, 4);
}

TEST(EmbreeScene, DoesNotTraceWhatIsBehindAPatch) {
  // A wall that goes as far below the floor as above it: half of the rays come from behind.
  PatchSceneMaker maker({4});
  const Box floor{{0, 0, -0.1F}, {1, 1, 0}};
  const Box wall{{2, 0, -1}, {3, 1, 1}};
  maker.cut_face(floor, 2, true, 0);
  maker.cut_face(wall, 0, false, 0);
  maker.add_box({{5, 5, 5}, {6, 6, 6}});
  const PatchScene scene = maker.take();
  const RayCounts counts = counts_of(scene, 256);
  EXPECT_EQ(counts.traced, 128U);
  EXPECT_EQ(counts.clear, 128U);
}

TEST(EmbreeScene, AsksForPacketsThatItTraces) {
  const unsigned packet = EmbreeScene(floor_and_ceiling({{5, 5, 1}, {6, 6, 2}})).packet();
  EXPECT_TRUE(packet == 4 || packet == 8 || packet == 16) << packet;
}

}  // namespace
}  // namespace shaftcull::bench
