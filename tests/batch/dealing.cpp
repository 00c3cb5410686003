// SPDX-License-Identifier: MIT
/// Pieces of work that are dealt to ranks, in two steps.
#include "batch/dealing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "batch/thread_ranks.hpp"

namespace shaftcull::test {
namespace {

using batch::Dealing;
using batch::Ranks;

const std::function<void()> nothing = [] {};

batch::Surroundings undisturbed_surroundings() {
  return {[](const std::function<void()>& work) { work(); }, [] { return 0; }};
}

TEST(BatchDealing, EveryPieceIsWorkedOnceAndFinishedInOrder) {
  for (const int size : {1, 2, 3, 5}) {
    for (const std::uint64_t pieces : {0U, 1U, 2U, 7U, 100U}) {
      SCOPED_TRACE(std::to_string(size) + " ranks, " + std::to_string(pieces) + " pieces");
      std::vector<std::atomic<int>> worked(pieces);
      std::vector<std::atomic<int>> finished(pieces);
      RankThreads(size).run([&](Ranks& ranks) {
        const batch::Surroundings surroundings = undisturbed_surroundings();
        Dealing dealing(ranks, surroundings, 1);
        std::vector<std::uint64_t> of_this_rank;
        std::atomic<int> under_way = 0;
        dealing.on_all_until_stopped(
            [&] {
              std::vector<std::uint64_t> begun;
              const auto work = [&](std::uint64_t piece) -> Dealing::Rest {
                ++worked[piece];
                begun.push_back(piece);
                return [&, piece] {
                  EXPECT_EQ(++under_way, 1);
                  ++finished[piece];
                  of_this_rank.push_back(piece);
                  --under_way;
                };
              };
              dealing.each(0, pieces, work, nothing);
              EXPECT_EQ(of_this_rank, begun);
            },
            "stopped");
        EXPECT_EQ(dealing.finished(), pieces);
      });
      const auto is_one = [](const std::atomic<int>& times) { return times == 1; };
      EXPECT_TRUE(std::ranges::all_of(worked, is_one));
      EXPECT_TRUE(std::ranges::all_of(finished, is_one));
    }
  }
}

TEST(BatchDealing, APieceIsFinishedDuringTheWorkOfTheNext) {
  const std::unique_ptr<Ranks> alone = batch::one_rank();
  const batch::Surroundings surroundings = undisturbed_surroundings();
  Dealing dealing(*alone, surroundings, 1);
  std::promise<void> next_is_at_work;
  std::promise<void> first_is_finished;
  dealing.each(
      0, 2,
      [&](std::uint64_t piece) -> Dealing::Rest {
        if (piece == 1) {
          // If one waited for the other, both would wait for ever.
          next_is_at_work.set_value();
          EXPECT_EQ(first_is_finished.get_future().wait_for(std::chrono::minutes(1)), std::future_status::ready);
          return {};
        }
        return [&] {
          EXPECT_EQ(next_is_at_work.get_future().wait_for(std::chrono::minutes(1)), std::future_status::ready);
          first_is_finished.set_value();
        };
      },
      nothing);
  EXPECT_EQ(dealing.finished(), 2U);
}

TEST(BatchDealing, WhatEitherStepThrowsEndsAllRanks) {
  for (const bool in_rest : {false, true}) {
    std::atomic<int> told = 0;
    std::atomic<int> others = 0;
    std::atomic<std::uint64_t> begun = 0;
    RankThreads(3).run([&](Ranks& ranks) {
      const batch::Surroundings surroundings = undisturbed_surroundings();
      Dealing dealing(ranks, surroundings, 1);
      const auto work = [&](std::uint64_t piece) -> Dealing::Rest {
        ++begun;
        const auto fail = [piece] {
          if (piece == 5) throw std::runtime_error("no room");
        };
        if (!in_rest) fail();
        return fail;
      };
      try {
        dealing.on_all_until_stopped([&] { dealing.each(0, 1'000'000, work, nothing); }, "stopped");
      } catch (const batch::OtherRankFailed&) {
        ++others;
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "no room");
        ++told;
      }
    });
    EXPECT_EQ(told, 1);
    EXPECT_EQ(others, 2);
    EXPECT_LT(begun, 1'000'000U);
  }
}

TEST(BatchDealing, ASignalEndsThePhaseWhenWhatWasBegunIsFinished) {
  std::atomic<std::uint64_t> begun = 0;
  std::atomic<std::uint64_t> finished = 0;
  std::atomic<int> stopped = 0;
  RankThreads(2).run([&](Ranks& ranks) {
    const batch::Surroundings surroundings{[](const std::function<void()>& work) { work(); },
                                           [&] { return begun >= 10 ? 15 : 0; }};
    Dealing dealing(ranks, surroundings, 1);
    const auto work = [&](std::uint64_t) -> Dealing::Rest {
      ++begun;
      return [&] { ++finished; };
    };
    try {
      dealing.on_all_until_stopped([&] { dealing.each(0, 1'000'000, work, nothing); }, "stopped");
    } catch (const batch::Stopped& stop) {
      EXPECT_EQ(stop.signal(), 15);
      ++stopped;
    } catch (const batch::OtherRankFailed&) {
    }
  });
  EXPECT_EQ(stopped, 1);
  EXPECT_EQ(begun, finished);
  EXPECT_LT(begun, 1'000'000U);
}

TEST(BatchDealing, TheThreadsAreTheSameForAllPieces) {
  const std::unique_ptr<Ranks> alone = batch::one_rank();
  const batch::Surroundings surroundings = undisturbed_surroundings();
  Dealing dealing(*alone, surroundings, 1);
  std::vector<std::thread::id> working;
  std::vector<std::thread::id> finishing;
  dealing.each(
      0, 20,
      [&](std::uint64_t) -> Dealing::Rest {
        working.push_back(std::this_thread::get_id());
        return [&] { finishing.push_back(std::this_thread::get_id()); };
      },
      nothing);
  EXPECT_EQ(working, std::vector<std::thread::id>(20, working[0]));
  EXPECT_EQ(finishing, std::vector<std::thread::id>(20, finishing[0]));
  EXPECT_NE(working[0], finishing[0]);
}

}  // namespace
}  // namespace shaftcull::test
