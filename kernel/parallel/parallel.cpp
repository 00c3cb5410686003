// SPDX-License-Identifier: MIT
#include "parallel/parallel.hpp"

#include <algorithm>
#include <limits>

#include "parallel/executor.hpp"
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
namespace {

int threads_of(const Executor& executor) noexcept {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  return static_cast<int>(std::clamp<std::size_t>(executor.threads(), 1, most));
}

}  // namespace

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

int threads_here() noexcept {
  if (const Executor* const executor = executor_in_use()) return threads_of(*executor);
  return tbb::this_task_arena::max_concurrency();
}

void parallel_for(std::size_t rows, std::size_t columns, Body body) {
  if (rows == 1 && columns == 1) return in_float_environment([&] { body(0, 0); });
  if (rows == 0 || columns == 0) return;
  if (Executor* const executor = executor_in_use()) return run_on(*executor, rows, columns, body);
  apart_from_caller([&](tbb::task_group_context& context) { run_loop(rows, columns, body, context); });
}

void parallel_for_nested(std::size_t rows, std::size_t columns, Body body) {
  if (Executor* const executor = executor_in_use()) return run_on(*executor, rows, columns, body);
  run_loop(rows, columns, body);
}

void ordered_pipeline(std::size_t count, std::size_t slots, Body work, Body deliver) {
  if (Executor* const executor = executor_in_use()) return run_in_order_on(*executor, count, slots, work, deliver);
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

int threads_here() noexcept {
  const Executor* const executor = executor_in_use();
  return executor == nullptr ? 1 : threads_of(*executor);
}

void parallel_for(std::size_t rows, std::size_t columns, FunctionRef<void(std::size_t, std::size_t)> body) {
  if (Executor* const executor = executor_in_use()) return run_on(*executor, rows, columns, body);
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
  if (Executor* const executor = executor_in_use()) return run_in_order_on(*executor, count, slots, work, deliver);
  for (std::size_t i = 0; i != count; ++i) {
    in_float_environment([&] { work(i, i % slots); });
    deliver(i, i % slots);
  }
}

#endif

void run_apart(FunctionRef<void()> body) {
#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
  apart_from_caller([&](tbb::task_group_context& context) {
    run_loop(
        1, 1, [&](std::size_t, std::size_t) { body(); }, context);
  });
#else
  in_float_environment([&] { body(); });
#endif
}

#ifdef SHAFTCULL_MEMORY_OF_TBB

void* allocate_task_memory(std::size_t bytes) { return tbb::cache_aligned_allocator<std::byte>().allocate(bytes); }

void free_task_memory(void* memory, std::size_t bytes) noexcept {
  tbb::cache_aligned_allocator<std::byte>().deallocate(static_cast<std::byte*>(memory), bytes);
}

#else

namespace {

constexpr std::size_t line_bytes = 64;
constexpr std::align_val_t line{line_bytes};
constexpr std::size_t most_kept_bytes = std::size_t{1} << 17U;

/// Begins a block of task memory, which follows in the next cache line.
struct alignas(line_bytes) Block {
  std::size_t bytes;
};

void free_block(Block* block) noexcept { ::operator delete(block, line); }

/// Blocks that a thread freed and keeps, where it can free them at its end: two, since a task may need two at once.
class KeptBlocks {
 public:
  KeptBlocks() noexcept = default;
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
  ~KeptBlocks() {
    free_block(small_);
    free_block(large_);
  }

  /// A block of at least so many bytes, or null.
  [[nodiscard]] Block* take(std::size_t bytes) noexcept {
    if (fits(small_, bytes)) return std::exchange(small_, nullptr);
    if (fits(large_, bytes)) return std::exchange(large_, nullptr);
    return nullptr;
  }
  /// Keeps a block, unless it is larger than is worth it. Of three, the smallest one is freed.
  void put(Block* block) noexcept {
    if (block->bytes <= most_kept_bytes) {
      if (is_smaller(large_, block)) std::swap(large_, block);
      if (is_smaller(small_, block)) std::swap(small_, block);
    }
    free_block(block);
  }

 private:
  static bool fits(const Block* block, std::size_t bytes) noexcept { return block != nullptr && block->bytes >= bytes; }
  static bool is_smaller(const Block* kept, const Block* block) noexcept {
    return block != nullptr && (kept == nullptr || kept->bytes < block->bytes);
  }

  Block* small_ = nullptr;
  Block* large_ = nullptr;
};

KeptBlocks& kept_by_this_thread() noexcept {
  SHAFTCULL_OF_THIS_THREAD KeptBlocks kept;
  return kept;
}

}  // namespace

void* allocate_task_memory(std::size_t bytes) {
  Block* block = nullptr;
  if constexpr (thread_objects_may_have_destructors) block = kept_by_this_thread().take(bytes);
  if (block == nullptr) {
    block = new (::operator new(sizeof(Block) + bytes, line)) Block{bytes};
  }
  return block + 1;
}

void free_task_memory(void* memory, std::size_t /*bytes*/) noexcept {
  Block* const block = static_cast<Block*>(memory) - 1;
  if constexpr (thread_objects_may_have_destructors) {
    kept_by_this_thread().put(block);
  } else {
    free_block(block);
  }
}

#endif

}  // namespace shaftcull::kernel

namespace SHAFTCULL_INTERFACE shaftcull {

int concurrency() noexcept { return kernel::threads_here(); }

}  // namespace shaftcull
