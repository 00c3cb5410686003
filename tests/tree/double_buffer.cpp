// SPDX-License-Identifier: MIT
/// Two trees, one asked while the other is updated, so that queries never wait for an update.
#include <gtest/gtest.h>

#include <thread>
#include <utility>
#include <vector>

#include "many/workload.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"

namespace shaftcull {
namespace {

TEST(TreeDoubleBuffer, TheLastFrameIsAskedWhileTheNextIsUpdated) {
  Random random(91);
  const std::vector<CompiledShaft> shafts = shafts_for(random, 40);
  std::vector<Box> bounds = scene<Box>(random, Shape::uniform, 20000);
  BoxTree asked{std::span<const Box>(bounds)};
  BoxTree updated = asked;
  for (int frame = 0; frame != 4; ++frame) {
    const std::vector<Box> next = scene<Box>(random, Shape::uniform, 20000);
    IndexLists kept;
    std::thread asker([&] { with_threads(2, [&] { list_many(shafts, asked, kept); }); });
    with_threads(2, [&] { updated.update(std::span<const Box>(next)); });
    asker.join();
    for (std::size_t s = 0; s != shafts.size(); ++s) EXPECT_EQ(sorted(kept[s]), FlatAnswers(shafts[s], bounds).kept());
    std::swap(asked, updated);
    bounds = next;
  }
}

// The first of them looks up the leaf of every index, whichever that is.
TEST(TreeDoubleBuffer, TheFirstQueriesAboutCandidatesMayBeManyAtOnce) {
  Random random(93);
  const std::vector<Box> bounds = scene<Box>(random, Shape::uniform, 20000);
  const CompiledShaft shaft = shafts_for(random, 1).front();
  const Indices candidates = FlatAnswers(shaft, bounds).kept();
  for (int round = 0; round != 20; ++round) {
    const BoxTree tree{std::span<const Box>(bounds)};
    std::vector<Indices> kept(4, Indices(candidates.size()));
    std::vector<std::thread> threads;
    for (Indices& each : kept) threads.emplace_back([&] { list(shaft, tree, each, {.only = candidates}); });
    for (std::thread& thread : threads) thread.join();
    for (const Indices& each : kept) EXPECT_EQ(each, candidates);
  }
}

TEST(TreeDoubleBuffer, ManyThreadsMayAskOneTree) {
  Random random(92);
  const std::vector<CompiledShaft> shafts = shafts_for(random, 40);
  const std::vector<Sphere> bounds = scene<Sphere>(random, Shape::uniform, 20000);
  const SphereTree tree{std::span<const Sphere>(bounds)};
  std::vector<IndexLists> kept(3);
  std::vector<std::thread> askers;
  for (IndexLists& lists : kept) askers.emplace_back([&] { list_many(shafts, tree, lists); });
  for (std::thread& asker : askers) asker.join();
  for (const IndexLists& lists : kept) {
    for (std::size_t s = 0; s != shafts.size(); ++s) EXPECT_EQ(sorted(lists[s]), FlatAnswers(shafts[s], bounds).kept());
  }
}

}  // namespace
}  // namespace shaftcull
