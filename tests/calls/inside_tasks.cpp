// SPDX-License-Identifier: MIT
/// Calls from within the tasks of a program that uses oneTBB itself: neither disturbs the other.
#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "calls/every_call.hpp"
#include "many/workload.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

constexpr int threads = 4;

/// Patches and occluders, whose sights are delivered in many batches.
struct Patches {
  PatchSet some{std::span<const Box>(random_boxes(3, 700))};
  PatchSet others{std::span<const Box>(random_boxes(4, 700))};
  Occluders occluders;

  Patches() { occluders.add_boxes(std::span<const Box>(random_boxes(5, 100))); }
  void deliver(FunctionRef<void(const SightBatch&)> to) const {
    VisibilityOptions options;
    options.memory = std::size_t{1} << 20;
    visibility(some, others, occluders, to, options);
  }
};

TEST(InsideTasks, AnswersAreRightWhereTheCallersGroupIsCancelled) {
  const EveryCall every(EveryCall::shafts(70), random_cases(5000));
  with_threads(threads, [&] {
    for (const PublicCall& call : every.calls()) {
      AnswerWords right;
      call.call(right);
      AnswerWords words;
      tbb::task_group group;
      group.run([&] {
        group.cancel();  // what runs goes on; what it starts within the group is dropped
        call.call(words);
      });
      group.wait();
      EXPECT_TRUE(words == right) << call.name;
    }
  });
}

TEST(InsideTasks, AnUpdateIsNotLostWhereTheCallersGroupIsCancelled) {
  const std::vector<Box> before = random_boxes(1, 100000);
  std::vector<Box> after = random_boxes(2, 100000);
  BoxTree tree{std::span<const Box>(before)};
  with_threads(threads, [&] {
    tbb::task_group group;
    group.run([&] {
      group.cancel();
      tree.update(std::span<const Box>(after));
    });
    group.wait();
  });
  for (std::size_t p = 0; p != tree.size(); ++p) ASSERT_EQ(tree.leaves()[p], after[tree.order()[p]]) << "leaf " << p;
  EXPECT_FALSE(tree.needs_refit());
}

// Were another task of the caller begun meanwhile, a mutex that the first one holds would be locked twice, and what it
// keeps in thread_local memory be overwritten.
TEST(InsideTasks, AThreadThatWaitsInsideACallTakesNoOtherTaskOfTheCaller) {
  const Patches patches;
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 3);
  tbb::task_arena arena(3, 2);  // the caller, another thread of the user's, and one of oneTBB's
  tbb::task_group group;
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> is_in_call = false;
  std::atomic<bool> is_over = false;
  std::atomic<bool> was_disturbed = false;
  std::atomic<bool> waits_in_callback = false;
  std::atomic<bool> go_on = false;

  // The user's other thread: has more to do as soon as the caller must wait.
  std::thread other([&] {
    while (!waits_in_callback && !is_over) std::this_thread::yield();
    arena.execute([&] {
      for (int i = 0; i != 8; ++i) {
        group.run([&] { was_disturbed = was_disturbed || (std::this_thread::get_id() == caller && is_in_call); });
      }
    });
    for (int i = 0; i != 100 && !was_disturbed; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    go_on = true;
  });
  arena.execute([&] {
    is_in_call = true;
    patches.deliver([&](const SightBatch&) {
      if (std::this_thread::get_id() == caller) {
        // Time for another thread to come and help.
        if (!waits_in_callback) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      } else {
        waits_in_callback = true;
        while (!go_on) std::this_thread::yield();
      }
    });
    is_over = true;
    is_in_call = false;
    other.join();
    group.wait();
  });
  if (!waits_in_callback) GTEST_SKIP() << "no other thread came to help, so this shows nothing";
  EXPECT_FALSE(was_disturbed);
}

TEST(InsideTasks, AnExceptionOfACallbackReachesTheCallerAndLeavesItsGroupAlone) {
  const Patches patches;
  with_threads(threads, [&] {
    tbb::task_group group;
    int caught = 0;
    group.run([&] {
      try {
        patches.deliver([](const SightBatch&) { throw std::runtime_error("enough"); });
      } catch (const std::runtime_error&) {
        ++caught;
      }
      EXPECT_FALSE(tbb::is_current_task_group_canceling());
    });
    EXPECT_EQ(group.wait(), tbb::task_group_status::complete);
    EXPECT_EQ(caught, 1);
  });
}

}  // namespace
}  // namespace shaftcull

#endif
