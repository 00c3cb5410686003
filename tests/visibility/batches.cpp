// SPDX-License-Identifier: MIT
/// How answers are delivered: every pair once, the same for any number of threads and any memory, with callbacks that
/// decide, watch, cancel and throw.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "caught.hpp"
#include "float_modes.hpp"
#include "instruction_sets.hpp"
#include "many/workload.hpp"
#include "message_of.hpp"
#include "oracle/sight_agreement.hpp"
#include "sanitizers.hpp"

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>
#endif

namespace shaftcull {
namespace {

constexpr std::size_t least_memory = std::size_t{1} << 20;

/// A scene that has answers of all kinds, with `patches` or more in each set, so that there are groups of groups.
SightCase large_case(bool is_of_one_set, unsigned patches, SightScenery scenery = SightScenery::room) {
  for (std::uint64_t seed = 1;; ++seed) {
    SightScene scene = random_sight_scene(scenery, seed, 2 * patches);
    if (scene.is_of_one_set != is_of_one_set || scene.a.size() < patches || scene.a_planes.empty()) continue;
    if (!is_of_one_set && (scene.b.size() < patches || scene.b_planes.empty())) continue;
    scene.solids_around_ends = true;
    SightCase of(std::move(scene));
    const SightCounts counts = of.count(of.options);
    if (std::min({counts.undecided, counts.clear, counts.occluded, counts.facing_away}) > patches) return of;
  }
}

/// Batches, as they came.
struct Batches {
  std::vector<std::vector<PairBlock>> blocks;
  std::vector<std::vector<PatchPair>> undecided;
  std::vector<std::vector<std::size_t>> first_candidate;
  std::vector<std::vector<std::uint32_t>> candidates;
  SightCounts counts;
  friend bool operator==(const Batches&, const Batches&) = default;
};

Batches batches_of(const SightCase& of, const VisibilityOptions& options) {
  Batches all;
  all.counts = of.deliver(
      [&](const SightBatch& batch) {
        all.blocks.emplace_back(batch.blocks.begin(), batch.blocks.end());
        const UndecidedPairs& undecided = batch.undecided;
        all.undecided.emplace_back(undecided.pairs.begin(), undecided.pairs.end());
        all.first_candidate.emplace_back(undecided.first_candidate.begin(), undecided.first_candidate.end());
        all.candidates.emplace_back(undecided.candidates.begin(), undecided.candidates.end());
      },
      options);
  return all;
}

void expect_same(const Visibility& a, const Visibility& b) {
  EXPECT_EQ(a.blocks, b.blocks);
  EXPECT_EQ(a.undecided, b.undecided);
  EXPECT_EQ(a.first_candidate, b.first_candidate);
  EXPECT_EQ(a.candidates, b.candidates);
  EXPECT_EQ(a.counts, b.counts);
}

TEST(VisibilityBatches, AreTheSameForAnyNumberOfThreads) {
  for (const bool is_of_one_set : {false, true}) {
    const SightCase of = large_case(is_of_one_set, has_shadow_memory ? 800 : 1200);
    Batches one;
    with_threads(1, [&] { one = batches_of(of, of.options); });
    EXPECT_GT(one.blocks.size(), 2U);
    for (const int threads : {2, 3}) {
      with_threads(threads, [&] { EXPECT_EQ(batches_of(of, of.options), one) << threads << " threads"; });
    }
    EXPECT_EQ(one.counts.total(), of.pairs());
  }
}

TEST(VisibilityBatches, HaveTheSameAnswersWhateverTheMemory) {
  for (const bool is_of_one_set : {false, true}) {
    const SightCase of = large_case(is_of_one_set, has_shadow_memory ? 200 : 400);
    const Visibility all = of.collect(of.options);
    EXPECT_EQ(SightTable(of, all).fault(), "");
    EXPECT_EQ(SightTable(of, all).counts(), all.counts);
    EXPECT_EQ(all.counts.total(), of.pairs());
    EXPECT_EQ(of.count(of.options), all.counts);
    for (const std::size_t memory : {least_memory, 3 * least_memory + 7, std::size_t{SIZE_MAX / 2}}) {
      VisibilityOptions options = of.options;
      options.memory = memory;
      for (const int threads : {1, 3, 16}) {
        with_threads(threads, [&] { expect_same(of.collect(options), all); });
      }
      EXPECT_EQ(of.count(options), all.counts);
    }
    VisibilityOptions without = of.options;
    without.candidates = false;
    const Visibility bare = of.collect(without);
    EXPECT_EQ(bare.blocks, all.blocks);
    EXPECT_EQ(bare.undecided, all.undecided);
    EXPECT_TRUE(bare.first_candidate.empty());
    EXPECT_TRUE(bare.candidates.empty());
  }
}

TEST(VisibilityBatches, OrdersArePermutations) {
  Random random(3);
  for (const std::size_t count : {0U, 1U, 2U, 64U, 65U, 66U, 513U, 5000U}) {
    for (const bool are_alike : {false, true}) {
      std::vector<Box> boxes;
      for (std::size_t i = 0; i != count; ++i) boxes.push_back(are_alike ? Box{} : random.box(-1, 1, 0, 0.1F));
      const PatchSet set{std::span<const Box>(boxes)};
      std::vector<std::uint32_t> order(set.order().begin(), set.order().end());
      std::vector<std::uint32_t> right(count);
      std::iota(right.begin(), right.end(), 0U);
      std::sort(order.begin(), order.end());
      EXPECT_EQ(order, right);
      EXPECT_EQ(set.size(), count);
      const std::uint64_t pairs = count * (count - (count == 0 ? 0 : 1)) / 2;
      EXPECT_EQ(count_visibility(set, Occluders()).clear, pairs);
      EXPECT_EQ(count_visibility(set, set, Occluders()).clear, count * count);
    }
  }
  const PatchSet none;
  EXPECT_EQ(none.size(), 0U);
  EXPECT_FALSE(none.has_planes());
  EXPECT_TRUE(none.order().empty());
  bool was_called = false;
  EXPECT_EQ(visibility(none, Occluders(), [&](const SightBatch&) { was_called = true; }), SightCounts());
  EXPECT_FALSE(was_called);
}

TEST(VisibilityBatches, BitsAreThoseOfPairs) {
  for (const bool is_of_one_set : {false, true}) {
    const SightCase of = large_case(is_of_one_set, 150);
    const Visibility all = of.collect(of.options);
    const SightTable table(of, all);
    const std::size_t words = bit_words(of.b.size());
    for (const Sight sight : {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away}) {
      std::vector<std::uint64_t> bits(of.a.size() * words, ~std::uint64_t{0});
      EXPECT_EQ(of.bits(sight, bits, of.options), all.counts);
      for (std::size_t i = 0; i != of.a.size(); ++i) {
        for (std::size_t j = 0; j != 64 * words; ++j) {
          bool right = j < of.b.size() && table.at(i, j).sight == sight;
          if (is_of_one_set && j < of.b.size()) right = right || table.at(j, i).sight == sight;
          ASSERT_EQ((bits[i * words + j / 64] >> j % 64 & 1U) != 0, right) << i << ", " << j << ", " << name(sight);
        }
      }
    }
  }
}

/// A final word on most pairs that depends on nothing but the pair.
Sight word_on(const PatchPair& pair) { return static_cast<Sight>((pair.a * 7U + pair.b * 3U) % 4); }

TEST(VisibilityBatches, ResolvedPairsAreWhatTheUserSays) {
  for (const bool is_of_one_set : {false, true}) {
    const SightCase of = large_case(is_of_one_set, has_shadow_memory ? 200 : 400);
    const Visibility all = of.collect(of.options);
    const SightTable before(of, all);
    for (const bool with_candidates : {true, false}) {
      Visibility one;
      for (const std::size_t memory : {least_memory, std::size_t{256} << 20}) {
        std::atomic<std::uint64_t> asked = 0;
        std::atomic<bool> is_wrong = false;
        VisibilityOptions options = of.options;
        options.memory = memory;
        options.candidates = with_candidates;
        options.resolve = [&](const UndecidedPairs& undecided, std::span<Sight> verdict) {
          asked += verdict.size();
          bool is_right = verdict.size() == undecided.pairs.size() && !verdict.empty() &&
                          undecided.first_candidate.empty() != with_candidates;
          for (std::size_t i = 0; i != verdict.size(); ++i) {
            const SightTable::Entry& entry = before.at(undecided.pairs[i].a, undecided.pairs[i].b);
            is_right = is_right && verdict[i] == Sight::undecided && entry.sight == Sight::undecided;
            if (with_candidates) {
              const std::size_t first = undecided.first_candidate[i];
              is_right = is_right && std::equal(undecided.candidates.begin() + static_cast<std::ptrdiff_t>(first),
                                                undecided.candidates.begin() +
                                                    static_cast<std::ptrdiff_t>(undecided.first_candidate[i + 1]),
                                                entry.candidates.begin(), entry.candidates.end());
            }
            verdict[i] = word_on(undecided.pairs[i]);
          }
          if (!is_right) is_wrong = true;
        };
        Visibility after;
        with_threads(3, [&] { after = of.collect(options); });
        EXPECT_FALSE(is_wrong);
        EXPECT_EQ(asked, all.counts.undecided);
        const SightTable table(of, after);
        ASSERT_EQ(table.fault(), "");
        EXPECT_EQ(table.counts(), after.counts);
        EXPECT_EQ(after.counts.total(), of.pairs());
        for (const PatchPair& pair : all.undecided) {
          const SightTable::Entry& entry = table.at(pair.a, pair.b);
          ASSERT_EQ(entry.sight, word_on(pair));
          if (entry.sight == Sight::undecided && with_candidates) {
            ASSERT_EQ(entry.candidates, before.at(pair.a, pair.b).candidates);
          }
        }
        for (const int threads : {1, 16}) {
          with_threads(threads, [&] { expect_same(of.collect(options), after); });
        }
        if (one.blocks.empty()) one = after;
        expect_same(after, one);  // whatever the memory
        EXPECT_EQ(of.count(options), after.counts);
        std::vector<std::uint64_t> bits(of.a.size() * bit_words(of.b.size()));
        EXPECT_EQ(of.bits(Sight::occluded, bits, options), after.counts);
      }
    }
  }
}

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
/// Where two threads meet.
class Meeting {
 public:
  /// Waits for another thread, the first time; returns whether one came. If none does within a minute, none will.
  bool meet() {
    std::unique_lock lock(mutex_);
    ++came_;
    changed_.notify_all();
    return changed_.wait_for(lock, std::chrono::minutes(1), [&] { return came_ >= 2 || is_over_; }) ? came_ >= 2
                                                                                                    : give_up();
  }

 private:
  bool give_up() {
    is_over_ = true;
    changed_.notify_all();
    return false;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned came_ = 0;
  bool is_over_ = false;
};

/// Patches on two walls that face each other, `side` times `side` on each, and some small boxes between them: few pairs
/// are undecided, and every one could be.
struct TwoWalls {
  PatchSet left;
  PatchSet right;
  Occluders occluders;

  TwoWalls(unsigned side, unsigned between) {
    for (const bool is_left : {true, false}) {
      std::vector<Box> boxes;
      const float x = is_left ? -3.0F : 3.0F;
      for (unsigned row = 0; row != side; ++row) {
        for (unsigned column = 0; column != side; ++column) {
          const auto y = static_cast<float>(row);
          const auto z = static_cast<float>(column);
          boxes.push_back({{x, y, z}, {x, y + 1, z + 1}});
        }
      }
      (is_left ? left : right) = PatchSet(std::span<const Box>(boxes));
    }
    Random random(17);
    std::vector<Box> boxes;
    const auto end = static_cast<float>(side);
    for (unsigned i = 0; i != between; ++i) {
      const Vec3 at{random.uniform(-1, 1), random.uniform(0, end), random.uniform(0, end)};
      boxes.push_back({at, {at[0] + 0.01F, at[1] + 0.01F, at[2] + 0.01F}});
    }
    occluders.add_boxes(std::span<const Box>(boxes));
  }
};

// Few answers fit, however many there could be: then threads need not wait for each other.
TEST(VisibilityBatches, AreFoundSideBySideWhereMemoryIsSmall) {
  const TwoWalls walls(32, 30);
  VisibilityOptions options;
  options.memory = least_memory;
  Meeting meeting;
  std::atomic<bool> has_met = true;
  options.resolve = [&](const UndecidedPairs&, std::span<Sight>) {
    if (!meeting.meet()) has_met = false;
  };
  with_threads(2, [&] {
    const SightCounts counts = visibility(
        walls.left, walls.right, walls.occluders, [](const SightBatch&) {}, options);
    EXPECT_GT(counts.undecided, 10'000U);
    EXPECT_GT(counts.clear, 10 * counts.undecided);
  });
  EXPECT_TRUE(has_met) << "resolve() was called by one thread only";
}
#endif

TEST(VisibilityBatches, VerdictsMustBeSights) {
  const SightCase of = large_case(false, 100);
  VisibilityOptions options = of.options;
  const PatchPair bad = of.collect(options).undecided.front();
  std::atomic<std::size_t> position = 0;
  options.resolve = [&](const UndecidedPairs& undecided, std::span<Sight> verdict) {
    const auto at = std::find(undecided.pairs.begin(), undecided.pairs.end(), bad);
    if (at == undecided.pairs.end()) return;
    position = static_cast<std::size_t>(at - undecided.pairs.begin());
    verdict[position] = static_cast<Sight>(4);
  };
  const auto why = [&] {
    return "verdict[" + std::to_string(position) + "] = 4, of patches " + std::to_string(bad.a) + " and " +
           std::to_string(bad.b) + ", is none of Sight::undecided, Sight::clear, Sight::occluded and " +
           "Sight::facing_away";
  };
  const std::string collecting = message_of([&] { static_cast<void>(of.collect(options)); });
  EXPECT_EQ(collecting, why());
  const std::string counting = message_of([&] { static_cast<void>(of.count(options)); });
  EXPECT_EQ(counting, why());
}

#if defined(__cpp_exceptions)
TEST(VisibilityBatches, ExceptionsOfCallbacksArriveAsTheyAre) {
  const SightCase of = large_case(true, 300);
  for (const int threads : {1, 3}) {
    with_threads(threads, [&] {
      unsigned calls = 0;
      EXPECT_THROW(of.deliver(
                       [&](const SightBatch&) {
                         if (++calls == 1) throw std::out_of_range("deliver");
                       },
                       of.options),
                   std::out_of_range);
      EXPECT_EQ(calls, 1U);
      VisibilityOptions options = of.options;
      options.resolve = [](const UndecidedPairs&, std::span<Sight>) { throw std::length_error("resolve"); };
      EXPECT_THROW(static_cast<void>(of.count(options)), std::length_error);
      options.resolve = nullptr;
      options.progress = [](const VisibilityProgress&) -> bool { throw std::domain_error("progress"); };
      EXPECT_THROW(static_cast<void>(of.count(options)), std::domain_error);
    });
  }
}
#endif

TEST(VisibilityBatches, ProgressAscendsToTheTotal) {
  for (const bool is_of_one_set : {false, true}) {
    const SightCase of = large_case(is_of_one_set, 300);
    for (const bool writes : {false, true}) {
      std::vector<std::uint64_t> done;
      VisibilityOptions options = of.options;
      options.progress = [&](const VisibilityProgress& progress) {
        EXPECT_EQ(progress.total, of.pairs());
        done.push_back(progress.done);
        return true;
      };
      if (writes) {
        static_cast<void>(of.collect(options));
      } else {
        static_cast<void>(of.count(options));
      }
      ASSERT_GE(done.size(), 2U);
      EXPECT_EQ(done.front(), 0U);
      EXPECT_EQ(done.back(), of.pairs());
      EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
    }
  }
}

TEST(VisibilityBatches, ACancelledCallSaysHowFarItCame) {
  const SightCase of = large_case(false, 300);
  VisibilityOptions options = of.options;
  options.progress = [](const VisibilityProgress&) { return false; };
  const std::string end = " of " + std::to_string(of.pairs()) + " pairs";
  bool was_delivered = false;
  EXPECT_EQ(message_of<Cancelled>([&] { of.deliver([&](const SightBatch&) { was_delivered = true; }, options); }),
            "the call was cancelled by its progress callback after 0" + end);
  EXPECT_FALSE(was_delivered);
  EXPECT_THROW(static_cast<void>(of.count(options)), Cancelled);
  options.progress = [&](const VisibilityProgress& progress) { return progress.done == 0; };
  EXPECT_THAT(message_of<Cancelled>([&] { static_cast<void>(of.collect(options)); }), testing::HasSubstr(end));
}

TEST(VisibilityBatches, CallsWithinCallbacksAnswerToo) {
  const SightCase of = large_case(false, 150);
  const SightCounts right = of.count(of.options);
  for (const int threads : {1, 3}) {
    with_threads(threads, [&] {
      unsigned calls = 0;
      VisibilityOptions options = of.options;
      options.resolve = [&](const UndecidedPairs&, std::span<Sight>) { EXPECT_EQ(of.count(of.options), right); };
      of.deliver(
          [&](const SightBatch&) {
            ++calls;
            EXPECT_EQ(of.count(of.options), right);
          },
          options);
      EXPECT_GT(calls, 0U);
    });
  }
}

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
TEST(VisibilityBatches, CallsInTasksAndCancelledGroupsAnswerToo) {
  const SightCase of = large_case(true, 150);
  const Visibility right = of.collect(of.options);
  with_threads(3, [&] {
    tbb::parallel_for(0, 6, [&](int) { EXPECT_EQ(of.collect(of.options).undecided, right.undecided); });
    Visibility all;
    tbb::task_group group;
    group.run([&] {
      group.cancel();
      all = of.collect(of.options);
    });
    group.wait();
    expect_same(all, right);
  });
}
#endif

#ifdef SHAFTCULL_HAS_FLOAT_MODES
TEST(VisibilityBatches, AreTheSameInAllFloatModesWhichAreLeftAsTheyWere) {
  for (const SightScenery scenery : {SightScenery::nudged, SightScenery::tiny, SightScenery::near_edges}) {
    for (std::uint64_t seed = 1; seed != 9; ++seed) {
      const SightScene scene = random_sight_scene(scenery, seed, 80);
      SCOPED_TRACE(std::string(name(scenery)) + ", " + std::to_string(seed));
      on_each_instruction_set([&] {
        const SightCase of(scene);
        const Visibility right = of.collect(of.options);
        for (const Mode& mode : modes) {
          SCOPED_TRACE(mode.name);
          Visibility all;
          FloatRegisters after = 0;
          {
            const InMode in(mode);
            const PatchSet a = first_set(scene);
            const PatchSet b = second_set(scene);
            const Occluders occluders = occluders_of(scene);
            all = scene.is_of_one_set ? collect_visibility(a, occluders, of.options)
                                      : collect_visibility(a, b, occluders, of.options);
            after = float_registers();
          }
          EXPECT_EQ(after & control_bits, mode.bits & control_bits);
          expect_same(all, right);
        }
      });
      if (HasFailure()) return;
    }
  }
}
#endif

#if defined(__STDCPP_THREADS__)
// What calls need besides is made by the first of them, whichever that is.
TEST(VisibilityBatches, TheFirstCallsMayBeManyAtOnce) {
  const SightCase of = large_case(false, 100);
  const SightCounts right = of.count(of.options);
  for (unsigned round = 0; round != 5; ++round) {
    const Occluders occluders = occluders_of(of.scene);
    std::vector<SightCounts> counts(4);
    std::vector<std::thread> threads;
    for (SightCounts& of_thread : counts) {
      threads.emplace_back([&] { of_thread = count_visibility(of.a, of.b, occluders, of.options); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const SightCounts& of_thread : counts) EXPECT_EQ(of_thread, right);
  }
}
#endif

TEST(VisibilityBatches, SolidsThatAreAddedBetweenCallsBlockToo) {
  const Box points[] = {{{0.5F, 0.5F, -9}, {0.5F, 0.5F, -9}}, {{0.25F, 0.5F, 9}, {0.75F, 0.5F, 9}}};
  const PatchSet patches{std::span<const Box>(points)};
  Occluders occluders;
  EXPECT_EQ(count_visibility(patches, occluders).clear, 1U);
  const Box first{{0, 0, 0}, {0.5F, 1, 1}};
  occluders.add_solids(std::span<const Box>(&first, 1));
  EXPECT_EQ(count_visibility(patches, occluders).undecided, 1U);
  const Occluders half = occluders;
  const Box second{{0.5F, 0, 0}, {1, 1, 1}};  // one box with the first
  occluders.add_solids(std::span<const Box>(&second, 1));
  EXPECT_EQ(count_visibility(patches, occluders).occluded, 1U);
  EXPECT_EQ(count_visibility(patches, half).undecided, 1U);
  EXPECT_EQ(count_visibility(patches, Occluders(occluders)).occluded, 1U);
}

TEST(VisibilityBatches, AnOccluderThatIsAddedToManyBetweenCallsIsACandidate) {
  constexpr std::size_t side = 150;
  std::vector<Box> points[2];
  for (std::size_t i = 0; i != side; ++i) {
    const float x = 0.4F + 0.001F * static_cast<float>(i);
    points[0].push_back({{x, 0.5F, -9}, {x, 0.5F, -9}});
    points[1].push_back({{x, 0.5F, 9}, {x, 0.5F, 9}});
  }
  const PatchSet below{std::span<const Box>(points[0])};
  const PatchSet above{std::span<const Box>(points[1])};
  Occluders occluders;
  occluders.add_boxes(std::span<const Box>(std::vector<Box>(5000, Box{{20, 0, 0}, {21, 1, 1}})));
  EXPECT_EQ(count_visibility(below, above, occluders).clear, side * side);
  const Box between{{0, 0, 0}, {1, 1, 1}};
  occluders.add_boxes(std::span<const Box>(&between, 1));
  EXPECT_EQ(count_visibility(below, above, occluders).clear, 0U);
}

TEST(VisibilityBatches, CallbacksRunInTheModesOfTheCaller) {
#ifdef SHAFTCULL_HAS_FLOAT_MODES
  const SightCase of = large_case(false, 300);
  for (const Mode& mode : modes) {
    SCOPED_TRACE(mode.name);
    const InMode in(mode);
    VisibilityOptions options = of.options;
    bool differs = false;
    const auto look = [&] { differs |= (float_registers() & control_bits) != (mode.bits & control_bits); };
    options.progress = [&](const VisibilityProgress&) {
      look();
      return true;
    };
    bool was_delivered = false;
    of.deliver(
        [&](const SightBatch&) {
          look();
          was_delivered = true;
        },
        options);
    EXPECT_TRUE(was_delivered);
    EXPECT_FALSE(differs);
  }
#else
  GTEST_SKIP() << "there are no modes";
#endif
}

TEST(VisibilityBatches, OccludersAreValuesAndNumberedAsTheyAreAdded) {
  const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}};
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}};
  const std::vector<std::size_t> whole{0, 4};
  std::vector<Triangle> triangles(70, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  const TriangleStream stream{std::span<const Triangle>(triangles)};
  Occluders occluders;
  EXPECT_EQ(occluders.add_boxes(std::span<const Box>(boxes)), 0U);
  EXPECT_EQ(occluders.add_solids(std::span<const Box>(boxes)), 2U);
  EXPECT_EQ(occluders.add_solid_hulls(corners, whole), 4U);
  EXPECT_EQ(occluders.add_polygons(std::span<const Vec3>(corners).subspan(0, 3), std::vector<std::size_t>{0, 3}), 5U);
  EXPECT_EQ(occluders.add_triangles(stream.view(), std::vector<std::size_t>{0, 1, 70}), 6U);
  EXPECT_EQ(occluders.add_triangles(stream.view()), 8U);
  const std::size_t size = occluders.size();
  EXPECT_GE(size, 8U + 3U);  // at most 32 in each
  EXPECT_EQ(occluders.box(3), boxes[1]);
  EXPECT_EQ(occluders.box(4), (Box{{0, 0, 0}, {1, 1, 5}}));
  EXPECT_TRUE(occluders.triangles(4).empty());
  EXPECT_EQ(occluders.triangles(6).size(), 1U);
  EXPECT_EQ(occluders.triangles(7).size(), 69U);
  std::vector<std::uint32_t> seen;
  for (std::size_t i = 8; i != size; ++i) {
    EXPECT_LE(occluders.triangles(i).size(), 32U);
    seen.insert(seen.end(), occluders.triangles(i).begin(), occluders.triangles(i).end());
  }
  std::sort(seen.begin(), seen.end());
  ASSERT_EQ(seen.size(), 70U);
  for (std::size_t i = 0; i != 70; ++i) EXPECT_EQ(seen[i], i);

  Occluders copy = occluders;
  copy.add_boxes(std::span<const Box>(boxes));
  EXPECT_EQ(copy.size(), size + 2);
  EXPECT_EQ(occluders.size(), size);
  Occluders moved = std::move(copy);
  EXPECT_EQ(moved.size(), size + 2);
  occluders = moved;
  EXPECT_EQ(occluders.size(), size + 2);
}

}  // namespace
}  // namespace shaftcull
