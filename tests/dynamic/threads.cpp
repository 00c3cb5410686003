// SPDX-License-Identifier: MIT
/// Threads that read snapshots while another one changes the tree.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

#include "dynamic/world.hpp"
#include "many/workload.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

/// All boxes of a state have this x: a state that is half of one commit and half of another has two of them.
Box at(float x, Random& random) {
  const float y = random.uniform(0, 100);
  const float z = random.uniform(0, 100);
  return {{x, y, z}, {x + 0.5F, y + 1, z + 1}};
}

TEST(DynamicThreads, ReadersSeeOneCommitAndNeverAPartOfTwo) {
  constexpr std::size_t bounds = 12000;
  const int frames = has_shadow_memory ? 12 : 60;
  DynamicBoxTree tree;
  Random random(40);
  std::vector<Box> boxes;
  std::vector<BoundId> ids(bounds);
  for (std::size_t i = 0; i != bounds; ++i) boxes.push_back(at(0, random));
  tree.insert(boxes, ids);
  tree.commit();
  std::atomic<bool> is_over = false;
  std::atomic<std::size_t> looks = 0;
  const auto read = [&] {
    float latest = 0;
    while (!is_over.load()) {
      const BoxTreeSnapshot now = tree.snapshot();
      const float x = now.box().lo[0];
      EXPECT_GE(x, latest);
      latest = x;
      EXPECT_EQ(now.box().hi[0], x + 0.5F);
      const CompiledShaft all = compile({{x, -1, -1}, {x, 102, 102}}, {{x + 0.5F, -1, -1}, {x + 0.5F, 102, 102}});
      EXPECT_EQ(count(all, now), now.bound_count());
      EXPECT_EQ(count(all, now), bounds);
      ++looks;
    }
  };
  std::vector<std::thread> readers;
  for (int i = 0; i != 3; ++i) readers.emplace_back(read);
  with_threads(2, [&] {
    for (int frame = 1; frame <= frames; ++frame) {
      for (std::size_t i = 0; i != bounds; ++i) {
        if (i % 7 == 0) {
          tree.erase(ids[i]);
          ids[i] = tree.insert(at(static_cast<float>(frame), random));
        } else {
          tree.move(ids[i], at(static_cast<float>(frame), random));
        }
      }
      tree.commit();
    }
  });
  while (looks.load() < 3) std::this_thread::yield();
  is_over.store(true);
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(tree.committed().box().lo[0], static_cast<float>(frames));
}

// Few changes: most blocks are those of states before, which readers still have.
TEST(DynamicThreads, ReadersKeepStatesWhoseBlocksAreShared) {
  World<Box> world(41);
  world.change({.count = 15000, .insertions = 10});
  world.tree.commit();
  std::vector<std::thread> readers;
  const int frames = has_shadow_memory ? 8 : 30;
  for (int frame = 0; frame != frames; ++frame) {
    world.change({.count = 40});
    world.tree.commit();
    readers.emplace_back([snapshot = world.tree.snapshot(), model = world.model, frame] {
      Random random(static_cast<std::uint64_t>(frame));
      expect_equal(snapshot, model, random);
    });
  }
  for (std::thread& reader : readers) reader.join();
}

}  // namespace
}  // namespace shaftcull
