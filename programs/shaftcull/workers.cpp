// SPDX-License-Identifier: MIT
#include "workers.hpp"

#include <algorithm>

#include <fmt/format.h>

#ifdef SHAFTCULL_CLI_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#endif

#include "shaftcull/error.hpp"

namespace shaftcull::cli {

#ifdef SHAFTCULL_CLI_WITH_TBB

struct Workers::Arena {
  // oneTBB starts no more threads than the machine has unless its limit is raised.
  explicit Arena(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control limit;
  tbb::task_arena arena;
};

Workers::Workers(int threads) {
  if (threads == 0) threads = tbb::this_task_arena::max_concurrency();
  arena_ = std::make_unique<Arena>(threads);
}

void Workers::run(const std::function<void()>& work) const { arena_->arena.execute(work); }

void Workers::for_chunks(std::size_t count, std::size_t chunk,
                         const std::function<void(std::size_t, std::size_t)>& work) {
  tbb::parallel_for(std::size_t{0}, (count + chunk - 1) / chunk,
                    [&](std::size_t i) { work(i * chunk, std::min(chunk, count - i * chunk)); });
}

void Workers::do_both(const std::function<void()>& one, const std::function<void()>& other) {
  tbb::parallel_invoke(one, other);
}

#else

struct Workers::Arena {};

Workers::Workers(int threads) {
  if (threads > 1) {
    throw InvalidArgument(fmt::format("--threads {}: this build has no oneTBB and runs on one thread", threads));
  }
}

void Workers::run(const std::function<void()>& work) const { work(); }

void Workers::for_chunks(std::size_t count, std::size_t chunk,
                         const std::function<void(std::size_t, std::size_t)>& work) {
  for (std::size_t first = 0; first < count; first += chunk) work(first, std::min(chunk, count - first));
}

void Workers::do_both(const std::function<void()>& one, const std::function<void()>& other) {
  one();
  other();
}

#endif

Workers::~Workers() = default;

}  // namespace shaftcull::cli
