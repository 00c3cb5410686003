// SPDX-License-Identifier: MIT
/// The state of a dynamic tree: blocks, the nodes above them, and where the bounds of indices are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "query/leaf_blocks.hpp"
#include "shaftcull/dynamic_tree.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"
#include "support/shared.hpp"
#include "tree/leaf_block.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// The places of some indices (LeafBlocks): 0 for those without a bound.
struct PlacePage : Ownable {
  std::uint32_t place[LeafBlocks::page_size] = {};
};

/// The number of the block behind all others, which has the leaf of indices without a bound.
inline constexpr std::uint32_t number_of_nothing = 0;

/// What a commit asks about every block, side by side.
struct BlockSize {
  std::uint32_t count = 0;
  std::uint32_t count_when_sorted = 0;
  float growth = 1;
  std::uint32_t changed = 0;  ///< bounds since then
  bool is_large = false;
  bool is_apart = false;
};
template <class Bound>
[[nodiscard]] BlockSize size_of(const LeafBlock<Bound>& block) noexcept {
  return {static_cast<std::uint32_t>(block.count),
          static_cast<std::uint32_t>(block.count_when_sorted),
          static_cast<float>(block.growth()),
          static_cast<std::uint32_t>(block.changed),
          block.is_large,
          block.is_apart};
}

/// Where blocks are, for queries: LeafBlocks refers to it.
template <class Bound>
struct BlockTables {
  std::vector<const float*> row;
  std::vector<const std::uint64_t*> taken;
  std::vector<const std::uint32_t*> order;
  std::vector<const std::uint32_t*> layers;  ///< empty if all bounds are in all layers

  /// Makes room for so many blocks, and for nothing behind them.
  void resize(std::size_t blocks, bool has_layers) {
    row.resize((blocks + 1) * rows_of<Bound>);
    taken.resize(blocks + 1);
    order.resize(blocks + 1);
    if (has_layers) layers.resize(blocks + 1);
  }
  void set(std::size_t position, const LeafBlock<Bound>& block) noexcept {
    for (std::size_t r = 0; r != rows_of<Bound>; ++r) row[position * rows_of<Bound> + r] = block.stream(r);
    taken[position] = block.taken;
    order[position] = block.order();
    if (!layers.empty()) layers[position] = block.layers();
  }
  /// Puts a single empty bound there: what indices without a bound have.
  void set_nothing(std::size_t position) noexcept {
    static constexpr std::uint32_t zero = 0;
    static constexpr std::uint64_t no_bits = 0;
    for (std::size_t r = 0; r != rows_of<Bound>; ++r) row[position * rows_of<Bound> + r] = padding_of<Bound>() + r;
    taken[position] = &no_bits;
    order[position] = &zero;
    if (!layers.empty()) layers[position] = &zero;
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return (row.capacity() + taken.capacity() + order.capacity() + layers.capacity()) * sizeof(void*);
  }
};

/// What a snapshot shows. `parts.blocks` refers to the tables here.
template <class Bound>
struct DynamicState : Ownable {
  DynamicState() = default;
  DynamicState(const DynamicState&) = delete;
  DynamicState& operator=(const DynamicState&) = delete;
  ~DynamicState() = default;

  TreeParts<Bound> parts;                        ///< nodes of all levels; no leaves
  std::vector<Shared<LeafBlock<Bound>>> blocks;  ///< by position
  std::vector<std::uint32_t> number_of;          ///< of the block at each position
  std::vector<BlockSize> size_of;                ///< of the block at each position
  std::vector<Shared<PlacePage>> pages;
  /// No earlier state has any of the pages. Not cleared when a later state shares them: only the last state is written.
  bool owns_pages = false;
  std::size_t index_end = 0;
  std::size_t count = 0;  ///< bounds
  bool has_layers = false;
  float node_size = 0;              ///< the usual size of a node of 64 (tree/size_class.hpp)
  std::size_t node_size_count = 0;  ///< bounds when that was found

  BlockTables<Bound> tables;
  std::vector<std::uint32_t*> place;       ///< of each page
  std::vector<std::uint32_t> position_of;  ///< of the block of each number

  [[nodiscard]] std::uint32_t place_of(std::uint32_t index) const noexcept {
    return place[index / LeafBlocks::page_size][index % LeafBlocks::page_size];
  }
  [[nodiscard]] bool has(std::uint32_t index) const noexcept { return index < index_end && place_of(index) != 0; }

  // Of an index that has a bound.
  void read(std::uint32_t index, float (&bound)[rows_of<Bound>]) const noexcept {
    const std::uint32_t place_of_bound = place_of(index);
    blocks[position_of[place_of_bound >> LeafBlocks::number_shift]]->read(place_of_bound % block_leaves, bound);
  }
  [[nodiscard]] std::uint32_t layers_of(std::uint32_t index) const noexcept {
    const std::uint32_t place_of_bound = place_of(index);
    return blocks[position_of[place_of_bound >> LeafBlocks::number_shift]]->layers_at(place_of_bound % block_leaves);
  }

  /// Prefetches the place of an index, and then its bound, if it has one.
  SHAFTCULL_ALWAYS_INLINE void prefetch_place(std::uint32_t index) const noexcept {
    if (index >= index_end) return;
    prefetch_to_second_level(place[index / LeafBlocks::page_size] + index % LeafBlocks::page_size, 1);
  }
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::uint32_t index) const noexcept {
    if (!has(index)) return;
    const std::uint32_t place_of_bound = place_of(index);
    const float* const* const stream =
        &tables.row[position_of[place_of_bound >> LeafBlocks::number_shift] * rows_of<Bound>];
    for (std::size_t r = 0; r != rows_of<Bound>; ++r) {
      prefetch_to_second_level(stream[r] + place_in_block(place_of_bound, rows_of<Bound>), 1);
    }
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = sizeof *this + parts.nodes.memory_bytes() + parts.gaps.bytes() + parts.layers.nodes.bytes() +
                      pages.size() * sizeof(PlacePage);
    for (const Shared<LeafBlock<Bound>>& block : blocks) sum += block->bytes();
    return sum + blocks.capacity() * (sizeof blocks[0] + sizeof number_of[0] + sizeof size_of[0]) + tables.bytes() +
           place.capacity() * sizeof(void*) + position_of.capacity() * sizeof position_of[0];
  }
};

}  // namespace shaftcull::kernel

namespace shaftcull {

template <class Bound>
struct TreeSnapshot<Bound>::State : kernel::DynamicState<Bound> {};

struct DynamicAccess {
  template <class Bound>
  struct Of {
    using State = typename TreeSnapshot<Bound>::State;
  };
  template <class Bound>
  using State = typename Of<Bound>::State;

  /// What queries read.
  template <class Bound>
  [[nodiscard]] static const kernel::TreeParts<Bound>& parts(const TreeSnapshot<Bound>& snapshot) noexcept {
    static const kernel::TreeParts<Bound> empty;
    return snapshot.state_ == nullptr ? empty : snapshot.state_->parts;
  }
  /// Null for a tree that was never changed.
  template <class Bound>
  [[nodiscard]] static auto& writer(DynamicTree<Bound>& tree) noexcept {
    return tree.writer_;
  }
  template <class Bound>
  [[nodiscard]] static const auto& writer(const DynamicTree<Bound>& tree) noexcept {
    return tree.writer_;
  }
  /// Null without bounds.
  template <class Bound>
  [[nodiscard]] static State<Bound>* state(const TreeSnapshot<Bound>& snapshot) noexcept {
    return snapshot.state_;
  }
  /// What the snapshot owns, which it has no more.
  template <class Bound>
  [[nodiscard]] static kernel::Shared<State<Bound>> take(TreeSnapshot<Bound>& snapshot) noexcept {
    return kernel::Shared<State<Bound>>::taken_over(std::exchange(snapshot.state_, nullptr));
  }
  /// A snapshot that owns the state.
  template <class Bound>
  [[nodiscard]] static TreeSnapshot<Bound> snapshot_of(kernel::Shared<State<Bound>> state) noexcept {
    TreeSnapshot<Bound> snapshot;
    snapshot.state_ = state.hand_over();
    return snapshot;
  }
};

namespace kernel {

/// The state of a snapshot.
template <class Bound>
using StateOf = DynamicAccess::State<Bound>;

}  // namespace kernel
}  // namespace shaftcull
