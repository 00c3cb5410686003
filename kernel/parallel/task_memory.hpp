/// Memory that tasks fill: not initialised, and the next call gets it again.
#pragma once

#include <cstddef>
#include <utility>

#include "parallel/parallel.hpp"

namespace shaftcull::kernel {

/// Room for `size` items, which are numbers or aggregates of them.
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

/// Room for `size` items that a task uses itself: on the stack, of which a call may take 64 KiB, where they are few.
template <class T, std::size_t few>
class TaskRoom {
 public:
  explicit TaskRoom(std::size_t size) : many_(size <= few ? 0 : size) {}
  TaskRoom(const TaskRoom&) = delete;
  TaskRoom& operator=(const TaskRoom&) = delete;
  [[nodiscard]] T* get() noexcept { return many_.get() != nullptr ? many_.get() : few_; }

 private:
  T few_[few];
  TaskMemory<T> many_;
};

}  // namespace shaftcull::kernel
