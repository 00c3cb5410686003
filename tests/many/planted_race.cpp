// SPDX-License-Identifier: MIT
/// Two races that ThreadSanitizer must find although kernel/parallel/thread_sanitizer.hpp and cmake/tsan.suppressions
/// tell it what to pass over: `test_planted_race loop` and `test_planted_race pipeline`. CTest has them in the preset
/// tsan only. A run without a report fails.
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

#include "many/workload.hpp"
#include "parallel/parallel.hpp"

namespace {

constexpr int threads = 2;

/// Two threads, each in a task of its own, take their turns: one races after the other, which ThreadSanitizer always
/// sees. Had both raced in the same instant, it could miss it: each would look for the other's trace before either had
/// left one. Relaxed, so that nothing but the clock orders them.
class Turns {
 public:
  template <class Race>
  void take(const Race& race) {
    const int turn = arrived_.fetch_add(1, std::memory_order_relaxed);
    while (arrived_.load(std::memory_order_relaxed) < threads || done_.load(std::memory_order_relaxed) < turn) {
      std::this_thread::yield();
    }
    race();
    done_.fetch_add(1, std::memory_order_relaxed);
  }

 private:
  std::atomic<int> arrived_ = 0;
  std::atomic<int> done_ = 0;
};

/// All tasks of a loop count in the same place.
std::size_t race_in_loop() {
  Turns turns;
  std::size_t count = 0;
  shaftcull::kernel::parallel_for(2, 1,
                                  [&](std::size_t /*row*/, std::size_t /*column*/) { turns.take([&] { ++count; }); });
  return count;
}

/// All items of a pipeline use the first slot.
std::size_t race_in_pipeline() {
  Turns turns;
  std::vector<std::size_t> slots(2);
  std::size_t sum = 0;
  shaftcull::kernel::ordered_pipeline(
      2, slots.size(), [&](std::size_t i, std::size_t /*slot*/) { turns.take([&] { slots[0] = i; }); },
      [&](std::size_t /*i*/, std::size_t /*slot*/) { sum += slots[0]; });
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const bool in_loop = argc == 2 && std::strcmp(argv[1], "loop") == 0;
  const bool in_pipeline = argc == 2 && std::strcmp(argv[1], "pipeline") == 0;
  if (!in_loop && !in_pipeline) {
    std::fprintf(stderr, "usage: test_planted_race loop|pipeline\n");
    return 2;
  }
  std::size_t result = 0;
  shaftcull::with_threads(threads, [&] { result = in_loop ? race_in_loop() : race_in_pipeline(); });
  std::printf("%zu\n", result);
  return 0;
}
