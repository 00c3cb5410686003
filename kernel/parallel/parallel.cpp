// SPDX-License-Identifier: MIT
#include "parallel/parallel.hpp"

#include "shaftcull/many.hpp"
#include "support/float_environment.hpp"

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/cache_aligned_allocator.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include "parallel/thread_sanitizer.hpp"
#define SHAFTCULL_MEMORY_OF_TBB 1
#endif

// ThreadSanitizer knows how the C library's allocator passes memory from thread to thread, but not how oneTBB's does.
#if !defined(SHAFTCULL_MEMORY_OF_TBB) || defined(SHAFTCULL_THREAD_SANITIZER)
#undef SHAFTCULL_MEMORY_OF_TBB
#include <new>
#include <utility>

#include "support/threads.hpp"
#endif

namespace shaftcull::kernel {

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB

namespace {

using Body = FunctionRef<void(std::size_t, std::size_t)>;

/// Runs start(context) apart from the caller's tasks. Tasks have the caller's floating-point modes, on all threads.
template <class Start>
void apart_from_caller(const Start& start) {
  using Context = tbb::task_group_context;
  Context context(Context::isolated, Context::default_traits | Context::fp_settings);
  tbb::this_task_arena::isolate([&] { start(context); });
}

/// Calls body(row, column) for all of rows × columns, in parallel and in no particular order. `how` is what oneTBB gets
/// besides.
template <class... How>
void run_loop(std::size_t rows, std::size_t columns, Body body, How&... how) {
  HappensBefore started;
  HappensBefore finished;
  started.release();
  const AcquireAtEnd all_finished(finished);
  const auto work_on = [&](const tbb::blocked_range2d<std::size_t>& range) {
    started.acquire();
    const ReleaseAtEnd one_finished(finished);
    in_float_environment([&] {
      for (std::size_t row = range.rows().begin(); row != range.rows().end(); ++row) {
        for (std::size_t column = range.cols().begin(); column != range.cols().end(); ++column) body(row, column);
      }
    });
  };
  tbb::parallel_for(tbb::blocked_range2d<std::size_t>(0, rows, 1, 0, columns, 1), work_on, how...);
}

}  // namespace

int threads_here() noexcept { return tbb::this_task_arena::max_concurrency(); }

void parallel_for(std::size_t rows, std::size_t columns, Body body) {
  if (rows == 1 && columns == 1) return in_float_environment([&] { body(0, 0); });
  if (rows == 0 || columns == 0) return;
  apart_from_caller([&](tbb::task_group_context& context) { run_loop(rows, columns, body, context); });
}

void parallel_for_nested(std::size_t rows, std::size_t columns, Body body) { run_loop(rows, columns, body); }

void ordered_pipeline(std::size_t count, std::size_t slots, Body work, Body deliver) {
  HappensBefore started;
  HappensBefore finished;
  HappensBefore entered;
  HappensBefore delivered;
  HappensBeforeSlots worked(slots);
  HappensBeforeSlots emptied(slots);
  started.release();
  const AcquireAtEnd all_finished(finished);
  // At most `slots` items are under way, and they leave in order: so i % slots is free when i enters.
  std::size_t next = 0;
  const auto enter = [&](tbb::flow_control& flow) -> std::size_t {
    started.acquire();
    entered.acquire();
    const ReleaseAtEnd one_finished(finished);
    const ReleaseAtEnd one_entered(entered);
    if (next == count) {
      flow.stop();
      return 0;
    }
    return next++;
  };
  const auto work_on = [&](std::size_t i) {
    started.acquire();
    emptied[i % slots].acquire();
    const ReleaseAtEnd one_finished(finished);
    in_float_environment([&] { work(i, i % slots); });
    worked[i % slots].release();
    return i;
  };
  const auto deliver_next = [&](std::size_t i) {
    started.acquire();
    worked[i % slots].acquire();
    delivered.acquire();
    const ReleaseAtEnd one_finished(finished);
    deliver(i, i % slots);
    delivered.release();
    emptied[i % slots].release();
  };
  const auto stages = tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, enter) &
                      tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, work_on) &
                      tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, deliver_next);
  apart_from_caller([&](tbb::task_group_context& context) { tbb::parallel_pipeline(slots, stages, context); });
}

#else

int threads_here() noexcept { return 1; }

void parallel_for(std::size_t rows, std::size_t columns, FunctionRef<void(std::size_t, std::size_t)> body) {
  in_float_environment([&] {
    for (std::size_t row = 0; row != rows; ++row) {
      for (std::size_t column = 0; column != columns; ++column) body(row, column);
    }
  });
}

void parallel_for_nested(std::size_t rows, std::size_t columns, FunctionRef<void(std::size_t, std::size_t)> body) {
  parallel_for(rows, columns, body);
}

void ordered_pipeline(std::size_t count, std::size_t slots, FunctionRef<void(std::size_t, std::size_t)> work,
                      FunctionRef<void(std::size_t, std::size_t)> deliver) {
  for (std::size_t i = 0; i != count; ++i) {
    in_float_environment([&] { work(i, i % slots); });
    deliver(i, i % slots);
  }
}

#endif

#ifdef SHAFTCULL_MEMORY_OF_TBB

void* allocate_task_memory(std::size_t bytes) { return tbb::cache_aligned_allocator<std::byte>().allocate(bytes); }

void free_task_memory(void* memory, std::size_t bytes) noexcept {
  tbb::cache_aligned_allocator<std::byte>().deallocate(static_cast<std::byte*>(memory), bytes);
}

#else

namespace {

constexpr std::align_val_t line{64};
constexpr std::size_t most_cached_bytes = std::size_t{1} << 17U;

/// Memory that a thread freed and keeps, where it can free that at its end.
struct Cached {
  void* memory = nullptr;
  std::size_t bytes = 0;
  Cached() noexcept = default;
  Cached(const Cached&) = delete;
  Cached& operator=(const Cached&) = delete;
  ~Cached() { ::operator delete(memory, line); }
};

Cached& cached_by_this_thread() noexcept {
  SHAFTCULL_OF_THIS_THREAD Cached cached;
  return cached;
}

}  // namespace

void* allocate_task_memory(std::size_t bytes) {
  if constexpr (thread_objects_may_have_destructors) {
    Cached& cached = cached_by_this_thread();
    if (cached.memory != nullptr && bytes <= cached.bytes) return std::exchange(cached.memory, nullptr);
  }
  return ::operator new(bytes, line);
}

void free_task_memory(void* memory, std::size_t bytes) noexcept {
  if constexpr (thread_objects_may_have_destructors) {
    Cached& cached = cached_by_this_thread();
    if (cached.memory == nullptr && bytes <= most_cached_bytes) {
      cached.memory = memory;
      cached.bytes = bytes;
      return;
    }
  }
  ::operator delete(memory, line);
}

#endif

}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

int concurrency() noexcept { return kernel::threads_here(); }

}  // namespace shaftcull
