// SPDX-License-Identifier: MIT
/// The memory of lists that a call fills.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shaftcull::kernel {

/// Lists in compressed sparse rows, from when a call begins to write them. Unless it says that they are complete, they
/// are empty at the end: an exception on the way leaves nothing that looks like an answer.
template <class Item>
class IncompleteLists {
 public:
  IncompleteLists(std::vector<std::uint64_t>& offsets, std::vector<Item>& items) noexcept
      : offsets_(offsets), items_(items) {}
  IncompleteLists(const IncompleteLists&) = delete;
  IncompleteLists& operator=(const IncompleteLists&) = delete;
  ~IncompleteLists() {
    if (is_complete_) return;
    offsets_.clear();
    items_.clear();
  }

  /// Makes room for `size` items without copying what is there, which is to be overwritten.
  void resize_items(std::uint64_t size) {
    if (items_.capacity() < size) items_.clear();
    items_.resize(static_cast<std::size_t>(size));
  }
  void complete() noexcept { is_complete_ = true; }

 private:
  std::vector<std::uint64_t>& offsets_;
  std::vector<Item>& items_;
  bool is_complete_ = false;
};

}  // namespace shaftcull::kernel
