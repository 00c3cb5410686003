// SPDX-License-Identifier: MIT
/// Blocks of bounds that are near each other.
#pragma once

#include <cstddef>
#include <vector>

#include "dynamic/members.hpp"
#include "kernels/kernel_table.hpp"
#include "support/shared.hpp"
#include "tree/leaf_block.hpp"
#include "tree/size_class.hpp"

namespace shaftcull::kernel {

/// Bounds that a sorted word or block gets: the free leaves are for those that come. Words that are nearly full cost
/// queries less, and insertions more.
inline constexpr std::size_t sorted_in_word = 58;
inline constexpr std::size_t sorted_in_block = 59 * sorted_in_word;

/// A block with more is sorted again with its neighbours, and one with fewer.
inline constexpr std::size_t most_in_block = block_leaves - 2 * fanout;
inline constexpr std::size_t fewest_in_block = block_leaves / 4;

template <class Bound>
using Blocks = std::vector<Shared<LeafBlock<Bound>>>;

/// How blocks are made.
struct BlockSorting {
  float node_size = 0;  ///< the usual size of a node, or 0 if it is not known
  bool has_layers = false;
  bool keeps_large_apart = true;  ///< bounds much larger than that get blocks of their own; else words
};

/// Whether a bound, as streams have it, is much larger than a usual node.
template <std::size_t rows>
[[nodiscard]] bool is_large(const float (&bound)[rows], float node_size) noexcept {
  const float extent = plain_placement(bound).extent;  // NaN for a bound that lies at infinity
  return node_size > 0 && extent == extent && !is_small(extent, node_size);
}

/// Sorts bounds into blocks: a k-d tree whose leaves are words. One task does it all.
template <class Bound>
[[nodiscard]] Blocks<Bound> sorted_blocks(const Members<Bound>& members, const BlockSorting& how,
                                          const Kernels& kernels);

/// The same by all threads. The same blocks for any number of them.
template <class Bound>
[[nodiscard]] Blocks<Bound> sorted_blocks_in_parallel(const Members<Bound>& members, const BlockSorting& how,
                                                      const Kernels& kernels);

}  // namespace shaftcull::kernel
