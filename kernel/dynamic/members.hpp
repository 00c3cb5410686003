// SPDX-License-Identifier: MIT
/// Bounds on their way from blocks to blocks.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "parallel/task_memory.hpp"
#include "tree/leaf_block.hpp"

namespace shaftcull::kernel {

/// Bounds, each in one piece, with their indices and layers. Memory is for so many.
template <class Bound>
class Members {
 public:
  static constexpr std::size_t rows = rows_of<Bound>;

  explicit Members(std::size_t most) : records_(most * rows), index_(most), layers_(most) {}

  void add(const float* bound, std::uint32_t index, std::uint32_t layers) noexcept {
    std::copy_n(bound, rows, records_.get() + count_ * rows);
    index_.get()[count_] = index;
    layers_.get()[count_] = layers;
    ++count_;
  }
  /// Adds the bounds of a block whose leaves are in `taken`.
  void add(const LeafBlock<Bound>& block, const std::uint64_t (&taken)[block_words]) noexcept {
    for (std::size_t w = 0; w != block_words; ++w) {
      for (std::uint64_t left = taken[w]; left != 0; left &= left - 1) {
        const std::size_t leaf = w * fanout + static_cast<std::size_t>(std::countr_zero(left));
        float bound[rows];
        block.read(leaf, bound);
        add(bound, block.order()[leaf], block.layers_at(leaf));
      }
    }
  }

  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] const float* records() const noexcept { return records_.get(); }
  [[nodiscard]] const float* bound(std::size_t i) const noexcept { return records_.get() + i * rows; }
  [[nodiscard]] std::uint32_t index(std::size_t i) const noexcept { return index_.get()[i]; }
  [[nodiscard]] std::uint32_t layers(std::size_t i) const noexcept { return layers_.get()[i]; }

 private:
  TaskMemory<float> records_;
  TaskMemory<std::uint32_t> index_;
  TaskMemory<std::uint32_t> layers_;
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
