// SPDX-License-Identifier: MIT
/// The nodes of a state, which are in one piece, from those of its blocks.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "tree/leaf_block.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// Copies the nodes of the block at position p to level 1: those of all its words, or of these.
template <class Bound>
void copy_nodes(TreeLevels<Bound>& parts, std::size_t p, const LeafBlock<Bound>& block,
                std::uint64_t words = ~std::uint64_t{0}) noexcept {
  const auto row = parts.node_rows(1, p * block_words);
  parts.gap_words(1)[p] = block.gaps;
  std::uint32_t* const layers =
      block.layers() == nullptr ? nullptr : parts.layers.nodes.data() + parts.level[1].first + p * block_words;
  if (~words == 0) {
    for (std::size_t f = 0; f != 6; ++f) std::copy_n(block.node[f], block_words, row[f]);
    if (layers != nullptr) std::copy_n(block.word_layers, block_words, layers);
    return;
  }
  for (; words != 0; words &= words - 1) {
    const auto w = static_cast<std::size_t>(std::countr_zero(words));
    for (std::size_t f = 0; f != 6; ++f) row[f][w] = block.node[f][w];
    if (layers != nullptr) layers[w] = block.word_layers[w];
  }
}

/// Finds the layers of entry i of level k, which is at least 2.
template <class Bound>
void fit_layers_of_node(TreeLevels<Bound>& parts, std::size_t k, std::size_t i) noexcept {
  const std::uint32_t* const below = parts.layers.nodes.data() + parts.level[k - 1].first + i * fanout;
  std::uint32_t& all = parts.layers.nodes.data()[parts.level[k].first + i];
  all = 0;
  for (std::size_t j = 0; j != fanout; ++j) all |= below[j];
}
/// Finds the layers of all nodes above level 1.
template <class Bound>
void fit_upper_layers(TreeLevels<Bound>& parts) noexcept {
  for (std::size_t k = 2; k < parts.levels; ++k) {
    for (std::size_t i = 0; i != parts.level[k].entries; ++i) fit_layers_of_node(parts, k, i);
  }
}

/// Fits the node of the block at position p, in level 2, to the block's nodes in level 1.
template <class Bound>
void fit_block_node(TreeLevels<Bound>& parts, const Kernels& kernels, std::size_t p,
                    const LeafBlock<Bound>& block) noexcept {
  fit_node_word(parts, kernels, 2, p);
  if (block.layers() != nullptr) fit_layers_of_node(parts, 2, p);
}

}  // namespace shaftcull::kernel
