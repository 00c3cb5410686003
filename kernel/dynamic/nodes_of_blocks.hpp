// SPDX-License-Identifier: MIT
/// The nodes of a state, which are in one piece, from those of its blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tree/leaf_block.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// Copies those of the block at position p to level 1.
template <class Bound>
void copy_nodes(TreeLevels<Bound>& parts, std::size_t p, const LeafBlock<Bound>& block) noexcept {
  const auto row = parts.node_rows(1, p * block_words);
  for (std::size_t f = 0; f != 6; ++f) std::copy_n(block.node[f], block_words, row[f]);
  parts.gap_words(1)[p] = block.gaps;
  if (block.layers() != nullptr) {
    std::copy_n(block.word_layers, block_words, parts.layers.nodes.data() + parts.level[1].first + p * block_words);
  }
}

/// Finds the layers of all nodes above level 1.
template <class Bound>
void fit_upper_layers(TreeLevels<Bound>& parts) noexcept {
  for (std::size_t k = 2; k < parts.levels; ++k) {
    const std::uint32_t* const below = parts.layers.nodes.data() + parts.level[k - 1].first;
    std::uint32_t* const here = parts.layers.nodes.data() + parts.level[k].first;
    for (std::size_t i = 0; i != parts.level[k].entries; ++i) {
      here[i] = 0;
      for (std::size_t j = 0; j != fanout; ++j) here[i] |= below[i * fanout + j];
    }
  }
}

}  // namespace shaftcull::kernel
