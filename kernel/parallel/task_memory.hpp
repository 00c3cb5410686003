// SPDX-License-Identifier: MIT
/// Memory that tasks fill. It is not initialised, and its allocator reuses it for the next call.
#pragma once

#include <cstddef>
#include <utility>

#include "parallel/parallel.hpp"

namespace shaftcull::kernel {

/// Memory for `size` items, which are numbers or aggregates of them.
template <class T>
class TaskMemory {
 public:
  TaskMemory() noexcept = default;
  explicit TaskMemory(std::size_t size)
      : items_(size == 0 ? nullptr : TaskAllocator<T>().allocate(size)), size_(size) {}
  TaskMemory(TaskMemory&& other) noexcept
      : items_(std::exchange(other.items_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  TaskMemory& operator=(TaskMemory&& other) noexcept {
    std::swap(items_, other.items_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~TaskMemory() {
    if (items_ != nullptr) TaskAllocator<T>().deallocate(items_, size_);
  }

  [[nodiscard]] T* get() const noexcept { return items_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  T* items_ = nullptr;
  std::size_t size_ = 0;
};

struct alignas(64) CacheLine {
  std::byte bytes[64];
};

/// Scratch memory of one task for `size` items: on the stack if they are at most `most_on_stack`, else allocated. A
/// call may take 64 KiB of stack.
template <class T, std::size_t most_on_stack>
class TaskScratch {
 public:
  explicit TaskScratch(std::size_t size) : allocated_(size <= most_on_stack ? 0 : size) {}
  TaskScratch(const TaskScratch&) = delete;
  TaskScratch& operator=(const TaskScratch&) = delete;
  [[nodiscard]] T* get() noexcept { return allocated_.get() != nullptr ? allocated_.get() : on_stack_; }

 private:
  T on_stack_[most_on_stack];
  TaskMemory<T> allocated_;
};

}  // namespace shaftcull::kernel
