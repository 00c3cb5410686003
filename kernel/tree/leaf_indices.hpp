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
  /// Of a tree whose leaves are in blocks: so many leaves, taken or not.
  LeafIndices(const LeafBlocks& blocks, std::size_t leaves, bool prefetches, const Kernels& kernels) noexcept
      : order_(nullptr),
        block_(blocks.order),
        size_(leaves),
        prefetched_(prefetches ? leaves : 0),
        compress_(kernels.compress_indices) {}

  [[nodiscard]] std::uint32_t operator[](std::size_t leaf) const noexcept { return *at(leaf); }

  /// Prefetches the indices of the word of leaves from `first` on.
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t first) const noexcept {
    if (first >= prefetched_) return;
    prefetch_to_second_level(at(first), fanout);
    prefetch_to_second_level(at(first) + fanout - 1, 1);  // a vector does not begin with a cache line
  }

  /// Writes those of the leaves [first, first + size).
  std::uint32_t* copy(std::size_t first, std::size_t size, std::uint32_t* out) const noexcept {
    if (block_ == nullptr) return std::copy_n(order_ + first, size, out);
    for (std::size_t leaf = first; leaf != first + size; leaf += fanout) out = std::copy_n(at(leaf), fanout, out);
    return out;
  }

  /// Writes those of the leaves `first` + i, for every set bit i, ascending. `out` must have space for 64, all of which
  /// may be overwritten. Returns how many.
  std::size_t compress(std::size_t first, std::uint64_t bits, std::uint32_t* out) const noexcept {
    if (first + fanout <= size_) return compress_(at(first), bits, out);
    return compress_exactly(first, bits, out);
  }
  /// The same, but nothing past them is overwritten.
  std::size_t compress_exactly(std::size_t first, std::uint64_t bits, std::uint32_t* out) const noexcept {
    std::uint32_t* end = out;
    const std::uint32_t* const order = at(first);
    for (; bits != 0; bits &= bits - 1) *end++ = order[std::countr_zero(bits)];
    return static_cast<std::size_t>(end - out);
  }

 private:
  /// Where the index of a leaf is, and those of others of its word.
  [[nodiscard]] const std::uint32_t* at(std::size_t leaf) const noexcept {
    return block_ == nullptr ? order_ + leaf : block_[leaf / block_leaves] + leaf % block_leaves;
  }

  const std::uint32_t* order_;
  const std::uint32_t* const* block_ = nullptr;
  std::size_t size_;        // vectors do not read past it
  std::size_t prefetched_;  // leaves before this one are worth prefetching
  CompressIndices* compress_;
};

}  // namespace shaftcull::kernel
