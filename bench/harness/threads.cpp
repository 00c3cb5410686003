// SPDX-License-Identifier: MIT
#include "harness/threads.hpp"

#include <algorithm>

#ifdef SHAFTCULL_BENCH_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace shaftcull::bench {

#ifdef SHAFTCULL_BENCH_WITH_TBB

unsigned all_threads() noexcept { return static_cast<unsigned>(tbb::info::default_concurrency()); }

void run_on(unsigned threads, const std::function<void()>& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute(work);
}

void for_chunks(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& work) {
  tbb::parallel_for(std::size_t{0}, (count + size - 1) / size,
                    [&](std::size_t i) { work(i * size, std::min(size, count - i * size)); });
}

#else

unsigned all_threads() noexcept { return 1; }

void run_on(unsigned /*threads*/, const std::function<void()>& work) { work(); }

void for_chunks(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& work) {
  for (std::size_t first = 0; first < count; first += size) work(first, std::min(size, count - first));
}

#endif

std::vector<unsigned> thread_counts() {
  std::vector<unsigned> counts;
  for (unsigned count = 1; count < all_threads(); count *= 2) counts.push_back(count);
  counts.push_back(all_threads());
  return counts;
}

}  // namespace shaftcull::bench
