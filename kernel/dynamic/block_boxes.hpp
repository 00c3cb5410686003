// SPDX-License-Identifier: MIT
/// Where the blocks of a dynamic tree are, and which one a bound suits best.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "dynamic/nearest.hpp"
#include "dynamic/sort_blocks.hpp"
#include "tree/dynamic_access.hpp"

namespace shaftcull::kernel {

/// Boxes around blocks.
class BlockBoxes {
 public:
  /// Boxes of the blocks of a state. Refers to the nodes of the state: not to be read after these are written.
  template <class Bound>
  explicit BlockBoxes(const DynamicState<Bound>& state) : size_(state.blocks.size()) {
    if (state.parts.levels > 2) {
      const BoxView nodes = state.parts.node_words(2, 0, bit_words(state.blocks.size()));
      for (std::size_t f = 0; f != 6; ++f) box_[f] = nodes.stream[f];
    } else {
      fit(state.blocks);
    }
  }
  template <class Bound>
  explicit BlockBoxes(const Blocks<Bound>& blocks) : size_(blocks.size()) {
    fit(blocks);
  }
  BlockBoxes(const BlockBoxes&) = delete;
  BlockBoxes& operator=(const BlockBoxes&) = delete;

  [[nodiscard]] bool has(std::size_t block, const float (&corner)[6]) const noexcept {
    return box_holds(box_.data(), block, corner);
  }
  [[nodiscard]] NodeCorners corners(std::size_t block) const noexcept { return corners_at(box_.data(), block); }
  /// How much of block a is in block b, too: 0 to 1, by lengths.
  [[nodiscard]] float share_of(std::size_t a, std::size_t b) const noexcept {
    float share = 1;
    for (std::size_t k = 0; k != 3; ++k) {
      const float width = box_[k + 3][a] - box_[k][a];
      const float common = lesser(box_[k + 3][a], box_[k + 3][b]) - greater(box_[k][a], box_[k][b]);
      if (!(common >= 0)) return 0;
      if (width > 0) share *= common / width;
    }
    return share <= 1 ? share : 0;  // not of infinite ones
  }
  /// How large a box around two blocks is.
  [[nodiscard]] float measure_of_both(std::size_t a, std::size_t b) const noexcept {
    return measure_with(box_.data(), a, corners(b).corner);
  }
  /// The boxes, in streams padded to whole words.
  [[nodiscard]] BoxView view() const noexcept {
    return {{box_[0], box_[1], box_[2], box_[3], box_[4], box_[5]}, size_};
  }

 private:
  template <class Bound>
  void fit(const Blocks<Bound>& blocks) {
    const std::size_t stride = bit_words(blocks.size()) * fanout;
    memory_.resize(6 * stride);
    float* box[6];
    for (std::size_t f = 0; f != 6; ++f) {
      box[f] = memory_.data() + f * stride;
      box_[f] = box[f];
      std::fill_n(box[f], stride, padding_box[f]);
    }
    for (std::size_t b = 0; b != blocks.size(); ++b) {
      const float* node[6];
      for (std::size_t f = 0; f != 6; ++f) node[f] = blocks[b]->node[f];
      for (std::size_t w = 0; w != block_words; ++w) grow_box(box, b, corners_at(node, w).corner);
    }
  }

  std::size_t size_ = 0;
  std::vector<float> memory_;
  std::array<const float*, 6> box_{};
};

/// Finds the block that a bound suits best.
class BestBlock {
 public:
  /// Refers to the boxes of the state's blocks.
  template <class Bound>
  BestBlock(const DynamicState<Bound>& state, const BlockBoxes& boxes)
      : boxes_(boxes), words_(bit_words(state.blocks.size())), memory_(6 * bit_words(words_) * fanout) {
    const std::size_t stride = bit_words(words_) * fanout;
    for (std::size_t f = 0; f != 6; ++f) {
      around_[f] = memory_.data() + f * stride;
      std::fill_n(around_[f], stride, padding_box[f]);
    }
    for (unsigned large = 0; large != 2; ++large) {
      bias_[large].assign(words_ * fanout, ruled_out);
      has_any_[large].assign(words_, false);
    }
    for (std::size_t b = 0; b != state.blocks.size(); ++b) {
      const bool is_large = state.size_of[b].is_large;
      bias_[is_large][b] = 0;
      has_any_[is_large][b / fanout] = true;
      if (is_large) continue;
      grow_box(around_, b / fanout, boxes.corners(b).corner);
    }
  }

  BestBlock(const BestBlock&) = delete;
  BestBlock& operator=(const BestBlock&) = delete;

  /// The block that a bound suits best, if there is any for it: of those for large bounds or of the others. Of these,
  /// one in a group that holds it, and otherwise of the group that it suits best. One group would not do: blocks at its
  /// rim would grow into the next, and with them the group.
  [[nodiscard]] std::optional<std::size_t> find(const float (&corner)[6], bool is_large,
                                                const Kernels& kernels) const noexcept {
    std::optional<BestOfNodes> best;
    for (std::size_t group = 0; group != words_; ++group) {
      if (!has_any_[is_large][group]) continue;
      if (!is_large && words_ > few_words && !box_holds(around_, group, corner)) continue;
      keep_better(best, best_in(group, corner, is_large, kernels));
    }
    if (!best && !is_large) {
      std::optional<BestOfNodes> nearest;
      for (std::size_t group = 0; group != words_; ++group) {
        if (!has_any_[0][group]) continue;
        keep_better(nearest, {group, cost_of_one_more(around_, group, corner)});
      }
      if (nearest) best = best_in(nearest->node, corner, false, kernels);
    }
    if (!best) return {};
    return best->node;
  }

 private:
  static constexpr std::size_t few_words = 2;  ///< up to so many words, all blocks are compared

  static void keep_better(std::optional<BestOfNodes>& best, const BestOfNodes& other) noexcept {
    if (!best || other.cost < best->cost) best = other;
  }
  [[nodiscard]] BestOfNodes best_in(std::size_t group, const float (&corner)[6], bool is_large,
                                    const Kernels& kernels) const noexcept {
    const std::size_t first = group * fanout;
    const BoxView nodes = boxes_.view();
    const float* row[6];
    for (std::size_t f = 0; f != 6; ++f) row[f] = nodes.stream[f] + first;
    float bias[fanout];
    std::copy_n(bias_[is_large].data() + first, fanout, bias);
    BestOfNodes best = best_node_for(row, corner, bias, kernels);
    best.node += first;
    return best;
  }

  const BlockBoxes& boxes_;
  std::size_t words_;
  std::vector<float> memory_;
  std::vector<float> bias_[2];    ///< of blocks for bounds that are not large, and for large ones
  std::vector<bool> has_any_[2];  ///< whether a group of 64 blocks has such a block
  float* around_[6];              ///< boxes around each 64 blocks
};

}  // namespace shaftcull::kernel
