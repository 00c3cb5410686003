// SPDX-License-Identifier: MIT
/// A commit that changes a few blocks of a state that nobody else has. Most of its cost is that of these blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "dynamic/block_writer.hpp"
#include "dynamic/nodes_of_blocks.hpp"

namespace shaftcull::kernel {

template <class Bound>
class ChangeInPlace {
 public:
  /// Whether a complete plan can be carried out in place: the table of blocks stays as it is.
  [[nodiscard]] static bool is_possible(const Shared<StateOf<Bound>>& state, const CommitPlan<Bound>& plan,
                                        bool adds_layers) noexcept {
    return state.is_only() && plan.groups().empty() && !adds_layers && !state->tables.row.empty();
  }

  /// Gets all memory. Throws std::bad_alloc, and then nothing has changed. Blocks and pages that other states share are
  /// copied.
  ChangeInPlace(DynamicState<Bound>& state, const CommitPlan<Bound>& plan, std::size_t index_end,
                const BlockWriter<Bound>& writer, const Kernels& kernels)
      : state_(state), plan_(plan), index_end_(index_end), writer_(writer), kernels_(kernels) {
    const std::size_t blocks = state.blocks.size();
    changed_.reserve(plan.walks_blocks() ? blocks : std::min(blocks, plan.steps().size()));
    for (std::size_t b = 0; b != blocks; ++b) {
      if (!plan.is_changed(b)) continue;
      changed_.push_back({b, 0, {}});
      const Shared<LeafBlock<Bound>>& block = state.blocks[b];
      if (block.is_only()) continue;
      changed_.back().copy = Shared<LeafBlock<Bound>>(new LeafBlock<Bound>(*block, state.has_layers));
    }
    is_written_.resize(changed_.size());
    const std::size_t pages = LeafBlocks::pages_for(index_end_);
    if (!state.owns_pages) {
      for (std::size_t i = 0; i != state.pages.size(); ++i) {
        if (!state.pages[i].is_only()) copied_pages_.push_back({i, Shared<PlacePage>(new PlacePage(*state.pages[i]))});
      }
    }
    for (std::size_t i = state.pages.size(); i < pages; ++i) new_pages_.push_back(Shared<PlacePage>(new PlacePage));
    state.pages.reserve(pages);
    state.place.reserve(pages);
    state.parts.blocks.place = state.place.data();
  }

  void run() noexcept {
    put_copies();
    write_each(changed_.size(), writer_.is_worth_tasks(), is_written_, [this](std::size_t i) {
      const std::size_t p = changed_[i].position;
      const PlaceWriter places(state_.place.data(), state_.number_of[p]);
      changed_[i].words = writer_.write(*state_.blocks[p], p, places);
    });
    state_.index_end = index_end_;
    state_.count = plan_.count();
    for (const Changed& changed : changed_) {
      const LeafBlock<Bound>& block = *state_.blocks[changed.position];
      state_.size_of[changed.position] = size_of(block);
      copy_nodes(state_.parts, changed.position, block, changed.words);
      if (state_.parts.levels > 2) fit_block_node(state_.parts, kernels_, changed.position, block);
    }
    fit_above_changed();
  }

 private:
  struct Changed {
    std::size_t position;
    std::uint64_t words;            ///< those that were written, as bits
    Shared<LeafBlock<Bound>> copy;  ///< null: the present one is changed
  };
  struct CopiedPage {
    std::size_t number;
    Shared<PlacePage> page;
  };

  void put_copies() noexcept {
    for (Changed& changed : changed_) {
      if (!changed.copy) continue;
      state_.blocks[changed.position] = std::move(changed.copy);
      state_.tables.set(changed.position, *state_.blocks[changed.position]);
    }
    for (CopiedPage& copied : copied_pages_) {
      state_.place[copied.number] = copied.page->place;
      state_.pages[copied.number] = std::move(copied.page);
    }
    for (Shared<PlacePage>& page : new_pages_) {
      state_.place.push_back(page->place);
      state_.pages.push_back(std::move(page));
    }
    state_.owns_pages = true;
  }
  /// Fits nodes above those of blocks. Changed blocks are in the order of their positions.
  void fit_above_changed() noexcept {
    TreeLevels<Bound>& parts = state_.parts;
    for (std::size_t k = 3; k < parts.levels; ++k) {
      std::size_t next = 0;  // entries before this one are fitted, or have no changed blocks
      for (const Changed& changed : changed_) {
        const std::size_t entry = changed.position >> 6 * (k - 2);
        if (entry < next) continue;
        fit_node_word(parts, kernels_, k, entry);
        if (state_.has_layers) fit_layers_of_node(parts, k, entry);
        next = entry + 1;
      }
    }
  }

  DynamicState<Bound>& state_;
  const CommitPlan<Bound>& plan_;
  std::size_t index_end_;
  const BlockWriter<Bound>& writer_;
  const Kernels& kernels_;
  std::vector<Changed> changed_;
  std::vector<std::uint8_t> is_written_;
  std::vector<CopiedPage> copied_pages_;
  std::vector<Shared<PlacePage>> new_pages_;
};

}  // namespace shaftcull::kernel
