// SPDX-License-Identifier: MIT
/// Numbers that a tree holds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "support/large_memory.hpp"

namespace shaftcull::kernel {

/// As many numbers as it was made for: in memory of its own, or where an image has them, which are only read. Copies
/// have memory of their own; what was moved from is empty.
template <class Number>
class TreeArray {
 public:
  TreeArray() noexcept = default;
  /// Not initialised.
  explicit TreeArray(std::size_t size) : own_(size), first_(own_.get()), size_(size) {}
  TreeArray(std::size_t size, Number value) : TreeArray(size) { std::fill_n(first_, size, value); }
  TreeArray(const TreeArray& other) : TreeArray(other.size_) { std::copy_n(other.first_, size_, first_); }
  TreeArray(TreeArray&& other) noexcept
      : own_(std::move(other.own_)),
        first_(std::exchange(other.first_, nullptr)),
        size_(std::exchange(other.size_, 0)) {}
  TreeArray& operator=(TreeArray other) noexcept {
    own_ = std::move(other.own_);
    first_ = std::exchange(other.first_, nullptr);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }
  ~TreeArray() = default;

  /// Numbers that stay where they are, longer than this. They may be in memory that cannot be written: nothing of it
  /// but const members is to be called.
  [[nodiscard]] static TreeArray in_place(std::span<const Number> numbers) noexcept {
    TreeArray array;
    array.first_ = const_cast<Number*>(numbers.data());
    array.size_ = numbers.size();
    return array;
  }

  [[nodiscard]] Number* data() noexcept { return first_; }
  [[nodiscard]] const Number* data() const noexcept { return first_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t bytes() const noexcept { return size_ * sizeof(Number); }
  [[nodiscard]] Number& operator[](std::size_t i) noexcept { return first_[i]; }
  [[nodiscard]] const Number& operator[](std::size_t i) const noexcept { return first_[i]; }
  [[nodiscard]] Number* begin() noexcept { return first_; }
  [[nodiscard]] Number* end() noexcept { return first_ + size_; }
  [[nodiscard]] const Number* begin() const noexcept { return first_; }
  [[nodiscard]] const Number* end() const noexcept { return first_ + size_; }

  friend bool operator==(const TreeArray& a, const TreeArray& b) noexcept { return std::ranges::equal(a, b); }

 private:
  LargeMemory<Number> own_;
  Number* first_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace shaftcull::kernel
