// SPDX-License-Identifier: MIT
/// Where lists go: into the caller's memory, into memory that grows, or into chunks of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "parallel/parallel.hpp"

namespace shaftcull::kernel {

// All have the same interface:
//   push(item)      adds one
//   count()         how many there are
// and that in the caller's memory also:
//   next()          where `most_added` items may be written, or null
//   advance(items)  so many were written there

/// Most items that a list adds between two calls of next(): a word of leaves.
inline constexpr std::size_t most_added = 64;

/// The caller's memory. What does not fit is only counted.
template <class Item>
class SpanOutput {
 public:
  explicit SpanOutput(std::span<Item> items) noexcept : items_(items) {}

  [[nodiscard]] Item* next() noexcept {
    return count_ + most_added <= items_.size() ? items_.data() + count_ : nullptr;
  }
  void advance(std::size_t items) noexcept { count_ += items; }
  void push(Item item) noexcept {
    if (count_ < items_.size()) items_[count_] = item;
    ++count_;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

 private:
  std::span<Item> items_;
  std::size_t count_ = 0;
};

/// Memory that grows, in one chunk.
template <class Item>
class GrowingOutput {
 public:
  GrowingOutput() noexcept = default;
  GrowingOutput(GrowingOutput&& other) noexcept
      : items_(std::exchange(other.items_, nullptr)),
        count_(std::exchange(other.count_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  GrowingOutput& operator=(GrowingOutput&&) = delete;
  ~GrowingOutput() {
    if (items_ != nullptr) Allocator().deallocate(items_, capacity_);
  }

  void push(Item item) {
    if (count_ == capacity_) grow();
    items_[count_++] = item;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] const Item* data() const noexcept { return items_; }

 private:
  using Allocator = TaskAllocator<Item>;
  static constexpr std::size_t least_items = 1024;

  void grow() {
    const std::size_t capacity = std::max(least_items, 2 * capacity_);
    Item* const items = Allocator().allocate(capacity);
    std::copy(items_, items_ + count_, items);
    if (items_ != nullptr) Allocator().deallocate(items_, capacity_);
    items_ = items;
    capacity_ = capacity;
  }

  Item* items_ = nullptr;
  std::size_t count_ = 0;
  std::size_t capacity_ = 0;
};

/// Memory that grows in chunks, so that nothing is copied on the way.
template <class Item>
class ChunkedOutput {
 public:
  void push(Item item) {
    if (chunks_.empty() || chunks_.back().size == chunks_.back().capacity) {
      chunks_.emplace_back(std::clamp(count_, least_chunk, most_chunk));
    }
    *chunks_.back().end() = item;
    ++chunks_.back().size;
    ++count_;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// Calls use(items, count) for chunk after chunk.
  template <class Use>
  void for_each_chunk(const Use& use) const {
    for (const Chunk& chunk : chunks_) use(static_cast<const Item*>(chunk.items), chunk.size);
  }

 private:
  using Allocator = TaskAllocator<Item>;
  static constexpr std::size_t least_chunk = 1024;
  static constexpr std::size_t most_chunk = std::size_t{1} << 17;

  struct Chunk {
    explicit Chunk(std::size_t items_at_most) : items(Allocator().allocate(items_at_most)), capacity(items_at_most) {}
    Chunk(Chunk&& other) noexcept
        : items(std::exchange(other.items, nullptr)), capacity(other.capacity), size(other.size) {}
    Chunk& operator=(Chunk&&) = delete;
    ~Chunk() {
      if (items != nullptr) Allocator().deallocate(items, capacity);
    }
    [[nodiscard]] Item* end() const noexcept { return items + size; }

    Item* items;
    std::size_t capacity;
    std::size_t size = 0;
  };

  std::vector<Chunk> chunks_;
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
