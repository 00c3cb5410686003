// SPDX-License-Identifier: MIT
/// The user's indices of leaves.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/kernel_table.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// Tree order, as the user's indices are read from it: word by word of leaves.
class LeafIndices {
 public:
  /// `prefetches` as TreeLevels::is_worth_prefetching().
  LeafIndices(std::span<const std::uint32_t> order, bool prefetches, const Kernels& kernels) noexcept
      : order_(order.data()),
        size_(order.size()),
        prefetched_(prefetches ? order.size() / fanout * fanout : 0),
        compress_(kernels.compress_indices) {}

  [[nodiscard]] std::uint32_t operator[](std::size_t leaf) const noexcept { return order_[leaf]; }

  /// Prefetches the indices of the word of leaves from `first` on.
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t first) const noexcept {
    if (first >= prefetched_) return;
    prefetch_to_second_level(order_ + first, fanout);
    prefetch_to_second_level(order_ + first + fanout - 1, 1);  // a vector does not begin with a cache line
  }

  /// Writes those of the leaves [first, first + size).
  std::uint32_t* copy(std::size_t first, std::size_t size, std::uint32_t* out) const noexcept {
    return std::copy_n(order_ + first, size, out);
  }

  /// Writes those of the leaves `first` + i, for every set bit i, ascending. `out` must have space for 64, all of which
  /// may be overwritten. Returns how many.
  std::size_t compress(std::size_t first, std::uint64_t bits, std::uint32_t* out) const noexcept {
    if (first + fanout <= size_) return compress_(order_ + first, bits, out);
    return compress_exactly(first, bits, out);
  }
  /// The same, but nothing past them is overwritten.
  std::size_t compress_exactly(std::size_t first, std::uint64_t bits, std::uint32_t* out) const noexcept {
    std::uint32_t* end = out;
    for (; bits != 0; bits &= bits - 1) *end++ = order_[first + static_cast<std::size_t>(std::countr_zero(bits))];
    return static_cast<std::size_t>(end - out);
  }

 private:
  const std::uint32_t* order_;
  std::size_t size_;        // vectors do not read past it
  std::size_t prefetched_;  // leaves before this one are worth prefetching
  CompressIndices* compress_;
};

}  // namespace shaftcull::kernel
