// SPDX-License-Identifier: MIT
/// Parallel loops and pipelines. Only parallel.cpp knows oneTBB, which SHAFTCULL_WITH_TBB turns on. If the caller has
/// set an executor, all runs on that (executor.hpp).
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

#include "shaftcull/function_ref.hpp"

namespace shaftcull::kernel {

/// Threads that a loop started here may use.
[[nodiscard]] int threads_here() noexcept;

/// Calls body(row, column) for all of rows × columns, in parallel and in no particular order, apart from the caller's
/// tasks. A single one is called as it is: its body must not start nested loops.
void parallel_for(std::size_t rows, std::size_t columns, FunctionRef<void(std::size_t, std::size_t)> body);

/// The same from within the body of a parallel_for(): its threads share the work.
void parallel_for_nested(std::size_t rows, std::size_t columns, FunctionRef<void(std::size_t, std::size_t)> body);

/// Calls body(), which runs tasks of oneTBB that are not ours, apart from the caller's tasks.
void run_apart(FunctionRef<void()> body);

/// Calls work(i, slot) in parallel and then deliver(i, slot) one at a time in ascending order, for i from 0 to count.
/// A slot, less than `slots`, belongs to i alone from its work to its delivery. Apart from the caller's tasks.
void ordered_pipeline(std::size_t count, std::size_t slots, FunctionRef<void(std::size_t, std::size_t)> work,
                      FunctionRef<void(std::size_t, std::size_t)> deliver);

/// Memory that tasks fill and others read, in whole cache lines. Memory that was freed is reused for the next call:
/// were it returned to the system, page faults would cost more than the copying.
[[nodiscard]] void* allocate_task_memory(std::size_t bytes);
void free_task_memory(void* memory, std::size_t bytes) noexcept;

template <class T>
struct TaskAllocator {
  [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(allocate_task_memory(count * sizeof(T))); }
  void deallocate(T* items, std::size_t count) noexcept { free_task_memory(items, count * sizeof(T)); }
};

}  // namespace shaftcull::kernel
