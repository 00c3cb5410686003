// SPDX-License-Identifier: MIT
/// A state of a dynamic tree that is put together from its blocks.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "dynamic/block_changes.hpp"
#include "dynamic/nodes_of_blocks.hpp"
#include "tree/build.hpp"
#include "tree/dynamic_access.hpp"

namespace shaftcull::kernel {

/// The position of a number that no block has.
inline constexpr std::uint32_t no_position = ~std::uint32_t{0};

/// Writes where the bounds of a block are.
template <class Bound>
void write_places(const LeafBlock<Bound>& block, const PlaceWriter& places) noexcept {
  for (std::size_t w = 0; w != block_words; ++w) {
    for (std::uint64_t left = block.taken[w]; left != 0; left &= left - 1) {
      const std::size_t leaf = w * fanout + static_cast<std::size_t>(std::countr_zero(left));
      places.set(block.order()[leaf], leaf);
    }
  }
}

/// First gets all memory, and then does the rest without throwing.
template <class Bound>
class StateParts {
 public:
  /// Gets memory for so many blocks, with numbers below `numbers`, which is 1 or more.
  void prepare(std::size_t blocks, std::size_t numbers, std::vector<Shared<PlacePage>> pages, bool has_layers) {
    pages_ = std::move(pages);
    places_.resize(pages_.size());
    for (std::size_t i = 0; i != pages_.size(); ++i) places_[i] = pages_[i]->place;
    has_layers_ = has_layers;
    const std::size_t nodes = lay_out_levels(levels_, blocks * block_leaves);
    levels_.nodes = BoxStream(nodes);
    levels_.gaps = {nodes / 64, ~std::uint64_t{0}};
    if (has_layers) levels_.layers.nodes = {nodes, 0U};
    blocks_.reserve(blocks);
    number_of_.reserve(blocks);
    size_of_.reserve(blocks);
    tables_.resize(blocks, has_layers);
    position_of_.assign(numbers, no_position);
  }

  /// Of each page, the places.
  [[nodiscard]] std::uint32_t* const* places() const noexcept { return places_.data(); }

  /// Adds the block at the next position.
  void add(const Shared<LeafBlock<Bound>>& block, std::uint32_t number) noexcept {
    const std::size_t position = blocks_.size();
    blocks_.push_back(block);
    number_of_.push_back(number);
    size_of_.push_back(size_of(*block));
    position_of_[number] = static_cast<std::uint32_t>(position);
    tables_.set(position, *block);
    copy_nodes(levels_, position, *block);
  }

  /// Puts everything into a state, once all blocks are added. Its numbers are the caller's to set.
  void move_to(DynamicState<Bound>& state, const Kernels& kernels) noexcept {
    position_of_[number_of_nothing] = static_cast<std::uint32_t>(blocks_.size());
    tables_.set_nothing(blocks_.size());
    std::swap(state.pages, pages_);
    std::swap(state.place, places_);
    std::swap(state.blocks, blocks_);
    std::swap(state.number_of, number_of_);
    std::swap(state.size_of, size_of_);
    std::swap(state.tables, tables_);
    std::swap(state.position_of, position_of_);
    state.has_layers = has_layers_;
    static_cast<TreeLevels<Bound>&>(state.parts) = std::move(levels_);
    state.parts.blocks = {state.tables.row.data(),   state.tables.taken.data(),
                          state.tables.order.data(), has_layers_ ? state.tables.layers.data() : nullptr,
                          state.place.data(),        state.position_of.data()};
    state.parts.layers.blocks = state.parts.blocks.layers;
    state.parts.layers.is_any_in_none = true;
    state.parts.layers.of_any = has_layers_ ? 0 : ~std::uint32_t{0};
    state.parts.layers.of_all = has_layers_ ? 0 : ~std::uint32_t{0};
    fit_upper(state.parts, kernels);
    if (has_layers_) fit_upper_layers(state.parts);
  }

 private:
  TreeLevels<Bound> levels_;
  std::vector<Shared<LeafBlock<Bound>>> blocks_;
  std::vector<std::uint32_t> number_of_;
  std::vector<BlockSize> size_of_;
  std::vector<Shared<PlacePage>> pages_;
  std::vector<std::uint32_t*> places_;
  BlockTables<Bound> tables_;
  std::vector<std::uint32_t> position_of_;
  bool has_layers_ = false;
};

}  // namespace shaftcull::kernel
