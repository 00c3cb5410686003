// SPDX-License-Identifier: MIT
/// Dynamic trees stay good: their nodes stay small, their blocks full, and their memory bounded, for as long as they
/// are changed.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "dynamic/world.hpp"

namespace shaftcull {
namespace {

/// Boxes of a world of which some are replaced and some move a little, frame after frame.
class Crowd {
 public:
  Crowd(std::size_t count, float world) : random_(30), world_(world), ids_(count) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i != count; ++i) boxes.push_back(somewhere());
    tree.insert(boxes, ids_);
    tree.commit();
  }
  void replace(std::size_t count) {
    for (std::size_t i = 0; i != count; ++i) {
      BoundId& id = ids_[random_.below(static_cast<unsigned>(ids_.size()))];
      tree.erase(id);
      id = tree.insert(somewhere());
    }
  }
  void shake(std::size_t count, float by) {
    for (std::size_t i = 0; i != count; ++i) {
      tree.move_by(ids_[random_.below(static_cast<unsigned>(ids_.size()))], random_.vec3(-by, by));
    }
  }
  DynamicBoxTree tree;

 private:
  [[nodiscard]] Box somewhere() { return random_.box(0, world_, 0.2F, 1); }

  Random random_;
  float world_;
  std::vector<BoundId> ids_;
};

TEST(TreeUpkeep, NodesStayAboutAsSmallAsWhenTheyWereSorted) {
  Crowd crowd(20000, 100);
  const std::size_t blocks = crowd.tree.upkeep().blocks;
  for (int frame = 0; frame != 300; ++frame) {
    crowd.replace(200);
    crowd.shake(200, 1);
    crowd.tree.commit();
    EXPECT_LT(crowd.tree.upkeep().sah_ratio, 1.2) << frame;
    EXPECT_LE(crowd.tree.upkeep().blocks, blocks + 2) << frame;
  }
}

TEST(TreeUpkeep, BoundsThatDriftApartAreSortedAgainWithTheirNeighbours) {
  Crowd crowd(20000, 100);
  for (int frame = 0; frame != 100; ++frame) {
    crowd.shake(20000, 1);
    crowd.tree.commit();
    EXPECT_LT(crowd.tree.upkeep().sah_ratio, 1.6) << frame;
  }
}

TEST(TreeUpkeep, CostsWhatItIsAllowedTo) {
  Crowd crowd(20000, 100);
  std::size_t sorted = 0;
  std::size_t most = 0;
  for (int frame = 0; frame != 300; ++frame) {
    crowd.replace(100);
    crowd.tree.commit();
    sorted += crowd.tree.upkeep().sorted_last;
    most = std::max(most, crowd.tree.upkeep().sorted_last);
  }
  EXPECT_GT(sorted, 0U);
  EXPECT_LT(sorted, (2U * 100 + 1024) * 300 + 20000);
  EXPECT_LT(most, 16500U);  // four blocks

  Crowd left_alone(20000, 100);
  left_alone.tree.set_sorted_per_change(0);
  for (int frame = 0; frame != 300; ++frame) {
    left_alone.replace(100);
    left_alone.tree.commit();
    EXPECT_EQ(left_alone.tree.upkeep().sorted_last, 0U) << frame;
  }
  EXPECT_GT(left_alone.tree.upkeep().sah_ratio, crowd.tree.upkeep().sah_ratio);
  EXPECT_GT(left_alone.tree.upkeep().waiting, 10000U);
}

TEST(TreeUpkeep, WhatWaitsIsSortedInTheEnd) {
  Crowd crowd(20000, 100);
  crowd.tree.set_sorted_per_change(0);
  for (int frame = 0; frame != 300; ++frame) {
    crowd.replace(100);
    crowd.tree.commit();
  }
  EXPECT_GT(crowd.tree.upkeep().waiting, 10000U);
  crowd.tree.set_sorted_per_change(0.01);
  for (int frame = 0; frame != 60; ++frame) crowd.tree.commit();  // which change nothing
  EXPECT_EQ(crowd.tree.upkeep().waiting, 0U);
}

// One huge bound makes the node around it huge: among small ones, every query would visit these.
TEST(TreeUpkeep, LargeBoundsHaveBlocksOfTheirOwn) {
  Crowd crowd(20000, 100);
  const std::size_t blocks = crowd.tree.upkeep().blocks;
  std::vector<BoundId> ids;
  for (int frame = 0; frame != 40; ++frame) {
    const float at = static_cast<float>(frame);
    ids.push_back(crowd.tree.insert(Box{{at, 0, 0}, {at + 60, 60, 60}}));
    crowd.replace(200);
    crowd.tree.commit();
    EXPECT_LE(crowd.tree.upkeep().blocks, blocks + 3) << frame;
    EXPECT_LT(crowd.tree.upkeep().sah_ratio, 1.5) << frame;
  }
  for (std::size_t i = 0; i != ids.size(); ++i) {  // they shrink, one after the other
    crowd.tree.move(ids[i], Box{{50, 50, 50}, {51, 51, 51}});
    crowd.tree.commit();
    EXPECT_LE(crowd.tree.upkeep().blocks, blocks + 3) << i;
  }
}

TEST(TreeUpkeep, MemoryIsTheBoundsAndLittleMore) {
  Crowd crowd(100000, 200);
  crowd.tree.commit();  // the memory for a hundred thousand changes is not kept
  const auto beside = [&] {
    return static_cast<double>(crowd.tree.memory_bytes()) / static_cast<double>(crowd.tree.bound_count()) - sizeof(Box);
  };
  EXPECT_LT(beside(), 24) << crowd.tree.upkeep().blocks << " blocks";
  for (int frame = 0; frame != 30; ++frame) {
    crowd.replace(1000);
    crowd.tree.commit();
  }
  EXPECT_LT(beside(), 26) << crowd.tree.upkeep().blocks << " blocks, ratio " << crowd.tree.upkeep().sah_ratio;
}

TEST(TreeUpkeep, ATreeThatShrinksGivesBlocksBack) {
  DynamicSphereTree tree;
  Random random(31);
  std::vector<BoundId> ids;
  for (int i = 0; i != 40000; ++i) ids.push_back(tree.insert({random.vec3(0, 100), 0.5F}));
  tree.commit();
  const std::size_t before = tree.upkeep().blocks;
  EXPECT_GE(before, 10U);
  for (std::size_t i = 0; i != ids.size(); ++i) {
    if (i % 20 != 0) tree.erase(ids[i]);
    if (i % 4000 == 0) tree.commit();
  }
  tree.commit();
  EXPECT_EQ(tree.bound_count(), 2000U);
  EXPECT_LE(tree.upkeep().blocks, 3U);
}

}  // namespace
}  // namespace shaftcull
