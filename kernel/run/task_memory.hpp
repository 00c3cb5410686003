/// Memory that tasks fill: not initialised, and the next call gets it again.
#pragma once

#include <cstddef>
#include <utility>

#include "run/parallel.hpp"

namespace shaftcull::kernel {

/// Room for `size` items, which are numbers or aggregates of them.
template <class T>
class TaskMemory {
 public:
  TaskMemory() noexcept = default;
  explicit TaskMemory(std::size_t size) : items_(TaskAllocator<T>().allocate(size)), size_(size) {}
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

}  // namespace shaftcull::kernel
