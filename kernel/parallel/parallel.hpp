// SPDX-License-Identifier: MIT
/// Parallel loops and pipelines: the only place that knows oneTBB, which SHAFTCULL_WITH_TBB turns on.
///
/// Everything runs inside the caller's task_arena, and exceptions reach the caller. A loop or pipeline that a public
/// call starts is apart from the caller's own tasks in both directions:
///
/// * Its task_group_context is its own. A caller's cancelled group would otherwise cancel the loop, which then returns
///   without having done its work.
/// * It is isolated. A thread that waits for the loop would otherwise take another of the caller's tasks meanwhile, in
///   the middle of the one that made the call.
///
/// Bodies of loops and the work of pipelines run in the standard floating-point modes (support/float_environment.hpp);
/// what a pipeline delivers is delivered in the caller's.
///
/// Loops within a loop's tasks (parallel_for_nested()) share context and isolation, so that all of a call's threads
/// help with them. Without oneTBB the same calls are made one after the other.
#pragma once

#include <cstddef>
#include <new>
#include <utility>

#include "support/float_environment.hpp"
#include "support/threads.hpp"

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/cache_aligned_allocator.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include "parallel/thread_sanitizer.hpp"
#endif

namespace shaftcull::kernel {

/// Allocates whole cache lines, for T of any alignment up to that. Each thread keeps one small array that it freed,
/// and reuses it, where it can free that at its end.
template <class T>
class CachingAllocator {
 public:
  [[nodiscard]] T* allocate(std::size_t count) {
    if constexpr (thread_objects_may_have_destructors) {
      Cached& cached = of_this_thread();
      if (cached.items != nullptr && count <= cached.count) return std::exchange(cached.items, nullptr);
    }
    return static_cast<T*>(::operator new(count * sizeof(T), line));
  }
  void deallocate(T* items, std::size_t count) noexcept {
    if constexpr (thread_objects_may_have_destructors) {
      Cached& cached = of_this_thread();
      if (cached.items == nullptr && count * sizeof(T) <= most_cached_bytes) {
        cached.items = items;
        cached.count = count;
        return;
      }
    }
    ::operator delete(items, line);
  }

 private:
  static constexpr std::align_val_t line{64};
  static constexpr std::size_t most_cached_bytes = std::size_t{1} << 17U;

  struct Cached {
    T* items = nullptr;
    std::size_t count = 0;
    Cached() noexcept = default;
    Cached(const Cached&) = delete;
    Cached& operator=(const Cached&) = delete;
    ~Cached() { ::operator delete(items, line); }
  };
  static Cached& of_this_thread() noexcept {
    SHAFTCULL_OF_THIS_THREAD Cached cached;
    return cached;
  }
};

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB

/// Allocates memory that tasks fill and others read. oneTBB's allocator reuses it for the next call. That of the C
/// library returns it to the system, and page faults cost more than the copying.
///
/// ThreadSanitizer knows how the C library's allocator passes memory from thread to thread, but not how oneTBB's does.
#ifdef SHAFTCULL_THREAD_SANITIZER
template <class T>
using TaskAllocator = CachingAllocator<T>;
#else
template <class T>
using TaskAllocator = tbb::cache_aligned_allocator<T>;
#endif

/// Threads that a loop started here may use.
[[nodiscard]] inline int threads_here() noexcept { return tbb::this_task_arena::max_concurrency(); }

/// Runs start(context) apart from the caller's tasks. Tasks have the caller's floating-point modes, on all threads.
template <class Start>
void apart_from_caller(const Start& start) {
  using Context = tbb::task_group_context;
  Context context(Context::isolated, Context::default_traits | Context::fp_settings);
  tbb::this_task_arena::isolate([&] { start(context); });
}

/// Calls body(row, column) for all of rows × columns, in parallel and in no particular order. `how` is what oneTBB gets
/// besides.
template <class Body, class... How>
void run_loop(std::size_t rows, std::size_t columns, const Body& body, How&... how) {
  HappensBefore started;
  HappensBefore finished;
  started.release();
  const AcquireAtEnd all_finished(finished);
  const auto work_on = [&](const auto& range) {
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

/// Calls body(row, column) for all of rows × columns, in parallel and in no particular order, apart from the caller's
/// tasks. A single one is called as it is: its body must not start nested loops.
template <class Body>
void parallel_for(std::size_t rows, std::size_t columns, const Body& body) {
  if (rows == 1 && columns == 1) return in_float_environment([&] { body(std::size_t{0}, std::size_t{0}); });
  if (rows == 0 || columns == 0) return;
  apart_from_caller([&](tbb::task_group_context& context) { run_loop(rows, columns, body, context); });
}

/// The same from within the body of a parallel_for(): its threads share the work.
template <class Body>
void parallel_for_nested(std::size_t rows, std::size_t columns, const Body& body) {
  run_loop(rows, columns, body);
}

/// Calls work(i, slot) in parallel and then deliver(i, slot) one at a time in ascending order, for i from 0 to count.
/// A slot, less than `slots`, belongs to i alone from its work to its delivery. Apart from the caller's tasks.
template <class Work, class Deliver>
void ordered_pipeline(std::size_t count, std::size_t slots, const Work& work, const Deliver& deliver) {
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

template <class T>
using TaskAllocator = CachingAllocator<T>;

[[nodiscard]] inline int threads_here() noexcept { return 1; }

template <class Body>
void parallel_for(std::size_t rows, std::size_t columns, const Body& body) {
  in_float_environment([&] {
    for (std::size_t row = 0; row != rows; ++row) {
      for (std::size_t column = 0; column != columns; ++column) body(row, column);
    }
  });
}

template <class Body>
void parallel_for_nested(std::size_t rows, std::size_t columns, const Body& body) {
  parallel_for(rows, columns, body);
}

template <class Work, class Deliver>
void ordered_pipeline(std::size_t count, std::size_t slots, const Work& work, const Deliver& deliver) {
  for (std::size_t i = 0; i != count; ++i) {
    in_float_environment([&] { work(i, i % slots); });
    deliver(i, i % slots);
  }
}

#endif

}  // namespace shaftcull::kernel
