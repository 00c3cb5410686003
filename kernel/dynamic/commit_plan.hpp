// SPDX-License-Identifier: MIT
/// What a commit is to do: which blocks its changes are in, and which blocks are sorted again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "dynamic/block_boxes.hpp"
#include "dynamic/changes.hpp"
#include "dynamic/commit.hpp"
#include "dynamic/nearest.hpp"
#include "dynamic/sort_blocks.hpp"
#include "parallel/parallel.hpp"
#include "support/index_range.hpp"
#include "tree/dynamic_access.hpp"

namespace shaftcull::kernel {

/// What happens to a bound that a block has, or gets.
struct BlockStep {
  enum Kind : std::uint32_t { erase, move, insert };

  std::uint32_t change;
  std::uint32_t block;  ///< its position
  std::uint32_t leaf;   ///< of the bound that is erased or moved
  Kind kind;
};

/// Blocks that are sorted together, and bounds that have no block.
struct SortedGroup {
  std::vector<std::uint32_t> blocks;    ///< positions
  std::vector<std::uint32_t> arrivals;  ///< changes
  bool are_apart = false;               ///< afterwards: since they shared their space
};

template <class Bound>
class CommitPlan {
 public:
  /// Finds the steps of changes that need no block to be found. Refers to all arguments.
  CommitPlan(const DynamicState<Bound>& old, std::span<const Change<Bound>> changes, Upkeep& upkeep,
             const Kernels& kernels)
      : old_(old),
        changes_(changes),
        upkeep_(upkeep),
        kernels_(kernels),
        walks_blocks_(changes.size() >= many_changes && changes.size() >= old.count / 4),
        boxes_(old) {
    find_steps();
    earn_upkeep();
  }
  CommitPlan(const CommitPlan&) = delete;
  CommitPlan& operator=(const CommitPlan&) = delete;

  /// Whether so many bounds change that blocks are gone through leaf by leaf, and each bound is asked for its change.
  /// Then bounds that move within their block have no steps.
  [[nodiscard]] bool walks_blocks() const noexcept { return walks_blocks_; }
  /// Whether a block is written to, unless it is sorted again.
  [[nodiscard]] bool is_changed(std::size_t block) const noexcept {
    return walks_blocks_ || first_step_[block] != first_step_[block + 1];
  }
  /// How many bounds there will be.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  /// Changes whose bounds have no block yet.
  [[nodiscard]] std::span<const std::uint32_t> arrivals() const noexcept { return arrivals_; }
  /// Whether so many bounds come that the old blocks are not worth keeping.
  [[nodiscard]] bool is_worth_sorting_all() const noexcept {
    return !arrivals_.empty() && arrivals_.size() >= old_.count / 2;
  }

  /// Finds blocks for all, and chooses which are sorted again.
  void complete() {
    route();
    bucket_steps();
    choose_groups();
  }
  /// In the order of the changes: first those of bounds that have a block, and when it is complete those that come.
  [[nodiscard]] std::span<const BlockStep> steps() const noexcept { return steps_; }
  /// The same of one block.
  [[nodiscard]] std::span<const BlockStep> steps_of(std::size_t block) const noexcept {
    return std::span(by_block_).subspan(first_step_[block], first_step_[block + 1] - first_step_[block]);
  }
  [[nodiscard]] const std::vector<SortedGroup>& groups() const noexcept { return groups_; }
  [[nodiscard]] bool is_sorted_again(std::size_t block) const noexcept { return is_chosen_[block]; }
  /// How many bounds a block will have, unless it is sorted again.
  [[nodiscard]] std::size_t count_after(std::size_t block) const noexcept { return after_[block]; }

 private:
  /// Blocks that are sorted together because one of them has grown into others: from this share of it on.
  static constexpr std::size_t sorted_together = 4;
  static constexpr float much_shared = 0.75F;
  /// Of how many blocks a commit finds out how much they share with others: it compares each with all.
  [[nodiscard]] std::size_t looked_at() const noexcept { return changes_.size() < few_changes ? 1 : 4; }
  /// Commits of fewer changes look at one block.
  static constexpr std::size_t few_changes = 1024;
  /// Bounds that a commit may sort again whatever has changed, so that what waits is sorted in the end.
  static constexpr double in_any_case = 1024;

  /// Changes ahead whose places are prefetched.
  static constexpr std::size_t prefetched = 16;
  /// Fewer changes are taken one by one, and in one task.
  static constexpr std::size_t many_changes = 16384;

  /// What a task finds.
  struct Found {
    std::vector<BlockStep> steps;
    std::vector<std::uint32_t> arrivals;
    std::size_t moves = 0;
  };

  [[nodiscard]] std::size_t blocks() const noexcept { return old_.blocks.size(); }
  /// Whether a bound belongs into blocks of large ones. Of a single block it does not.
  [[nodiscard]] bool is_for_large(const Change<Bound>& change) const noexcept {
    return blocks() > 1 && is_large(change.bound, old_.node_size);
  }

  /// Finds the block of every bound that is erased or moved, and what has no block yet.
  void find_steps() {
    std::vector<Found> found(std::max<std::size_t>(chunk_count(changes_.size(), many_changes), 1));
    parallel_for(found.size(), 1,
                 [&](std::size_t t, std::size_t) { find_steps(chunk_at(changes_.size(), many_changes, t), found[t]); });
    steps_ = std::move(found[0].steps);
    arrivals_ = std::move(found[0].arrivals);
    moves_ = found[0].moves;
    for (std::size_t t = 1; t != found.size(); ++t) {
      steps_.insert(steps_.end(), found[t].steps.begin(), found[t].steps.end());
      arrivals_.insert(arrivals_.end(), found[t].arrivals.begin(), found[t].arrivals.end());
      moves_ += found[t].moves;
    }
    const std::size_t gone = walks_blocks_ ? steps_.size() : steps_.size() - moves_;
    count_ = old_.count + arrivals_.size() - gone;
  }
  void find_steps(const IndexRange& task, Found& found) const {
    if (!walks_blocks_) found.steps.reserve(task.size);
    for (std::size_t c = task.first; c != task.end(); ++c) {
      if (c + prefetched < task.end()) old_.prefetch_place(changes_[c + prefetched].index);
      const Change<Bound>& change = changes_[c];
      const auto number = static_cast<std::uint32_t>(c);
      const std::uint32_t place = change.index < old_.index_end ? old_.place_of(change.index) : 0;
      if (place == 0) {
        if (change.has_bound != 0) found.arrivals.push_back(number);
        continue;
      }
      const std::uint32_t block = old_.position_of[place >> LeafBlocks::number_shift];
      const std::uint32_t leaf = place % block_leaves;
      if (change.has_bound != 0 && stays_in(block, change)) {
        if (!walks_blocks_) found.steps.push_back({number, block, leaf, BlockStep::move});
        ++found.moves;
        continue;
      }
      found.steps.push_back({number, block, leaf, BlockStep::erase});
      if (change.has_bound != 0) found.arrivals.push_back(number);
    }
  }
  /// What the changes allow to be sorted again: an eighth for bounds that stay in their block.
  void earn_upkeep() noexcept {
    const double changed = static_cast<double>(changes_.size() - moves_) + static_cast<double>(moves_) / 8;
    const double most_saved = std::max<double>(static_cast<double>(count_) / 4, sorted_together * block_leaves);
    if (upkeep_.per_change > 0) upkeep_.saved += in_any_case;
    upkeep_.saved = std::min(upkeep_.saved + upkeep_.per_change * changed, most_saved);
  }

  [[nodiscard]] bool stays_in(std::uint32_t block, const Change<Bound>& change) const noexcept {
    float corner[6];
    corners_of(change.bound, corner);
    return boxes_.has(block, corner) && (blocks() == 1 || is_for_large(change) == old_.size_of[block].is_large);
  }

  /// Finds a block for every bound that has none.
  void route() {
    if (arrivals_.empty()) return;
    const std::size_t before = steps_.size();
    steps_.resize(before + arrivals_.size());
    const BestBlock best_block(old_, boxes_);
    constexpr std::size_t in_task = 1024;
    parallel_for(chunk_count(arrivals_.size(), in_task), 1, [&](std::size_t t, std::size_t) {
      const IndexRange task = chunk_at(arrivals_.size(), in_task, t);
      for (std::size_t i = task.first; i != task.end(); ++i) {
        const Change<Bound>& change = changes_[arrivals_[i]];
        float corner[6];
        corners_of(change.bound, corner);
        const std::size_t block = best_block.find(corner, is_for_large(change), kernels_).value_or(blocks());
        steps_[before + i] = {arrivals_[i], static_cast<std::uint32_t>(block), 0, BlockStep::insert};
      }
    });
    // There may be no block for large bounds, or none for others: they get a new one.
    const auto has_none = [this](const BlockStep& step) { return step.block == blocks(); };
    SortedGroup fresh;
    for (std::size_t i = before; i != steps_.size(); ++i) {
      if (has_none(steps_[i])) fresh.arrivals.push_back(steps_[i].change);
    }
    if (fresh.arrivals.empty()) return;
    steps_.erase(std::remove_if(steps_.begin() + static_cast<std::ptrdiff_t>(before), steps_.end(), has_none),
                 steps_.end());
    upkeep_.sorted_last += fresh.arrivals.size();
    groups_.push_back(std::move(fresh));
  }

  /// Sorts steps by block, and keeps their order otherwise: of a block, first those that go.
  void bucket_steps() {
    first_step_.assign(blocks() + 1, 0);
    for (const BlockStep& step : steps_) ++first_step_[step.block + 1];
    std::partial_sum(first_step_.begin(), first_step_.end(), first_step_.begin());
    by_block_.resize(steps_.size());
    std::vector<std::size_t> next(first_step_.begin(), first_step_.end() - 1);
    for (const BlockStep& step : steps_) by_block_[next[step.block]++] = step;
  }

  /// Chooses which blocks are sorted again, each with its neighbours: those that would be too full or too empty, and
  /// as many of those that have grown as the upkeep allows.
  void choose_groups() {
    after_.resize(blocks());
    is_chosen_.assign(blocks(), false);
    std::vector<std::uint32_t> by_growth;
    for (std::size_t b = 0; b != blocks(); ++b) {
      after_[b] = old_.size_of[b].count;
      for (const BlockStep& step : steps_of(b)) {
        after_[b] += step.kind == BlockStep::insert ? 1 : 0;
        after_[b] -= step.kind == BlockStep::erase ? 1 : 0;
      }
      if (has_grown(old_.size_of[b])) by_growth.push_back(static_cast<std::uint32_t>(b));
    }
    for (std::size_t b = 0; b != blocks(); ++b) {
      if (is_chosen_[b]) continue;
      const bool is_hollow = after_[b] < fewest_in_block && 2 * after_[b] < old_.size_of[b].count_when_sorted;
      if (after_[b] > most_in_block || is_hollow) add_group(b, 2);
    }
    std::stable_sort(by_growth.begin(), by_growth.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return old_.size_of[a].growth > old_.size_of[b].growth; });
    for (const std::uint32_t b : by_growth) {
      if (!is_chosen_[b] && !sort_again(b, needs_neighbours(b))) return;
    }
    // Blocks may share their space with others though their nodes are small.
    for (std::size_t i = 0; i != std::min(looked_at(), blocks()); ++i) {
      const std::size_t b = upkeep_.next_looked_at++ % blocks();
      if (!is_chosen_[b] && needs_neighbours(b) && !sort_again(b, true)) return;
    }
  }

  /// Whether the upkeep allows it.
  bool sort_again(std::size_t block, bool with_neighbours) {
    const std::size_t most = std::min(with_neighbours ? sorted_together : 1, blocks());
    if (upkeep_.saved < static_cast<double>(most * sorted_in_block)) return false;
    upkeep_.saved -= add_group(block, most);
    groups_.back().are_apart = with_neighbours;
    return true;
  }

  /// Whether a block shares much of its space, and was not sorted for that reason a short while ago.
  [[nodiscard]] bool needs_neighbours(std::size_t block) const noexcept {
    const BlockSize& size = old_.size_of[block];
    return !(size.is_apart && size.changed < size.count) && shares_much(block);
  }
  /// Whether other blocks of its kind cover much of it.
  [[nodiscard]] bool shares_much(std::size_t block) const noexcept {
    float shared = 0;
    for (std::size_t b = 0; b != blocks(); ++b) {
      if (b != block && are_of_a_kind(b, block)) shared += boxes_.share_of(block, b);
    }
    return shared > much_shared;
  }
  [[nodiscard]] bool are_of_a_kind(std::size_t a, std::size_t b) const noexcept {
    return old_.size_of[a].is_large == old_.size_of[b].is_large;
  }

  /// Returns how many bounds the group has.
  double add_group(std::size_t block, std::size_t most) {
    SortedGroup& group = groups_.emplace_back();
    std::size_t bounds = 0;
    const auto add = [&](std::size_t b) {
      is_chosen_[b] = true;
      group.blocks.push_back(static_cast<std::uint32_t>(b));
      bounds += after_[b];
    };
    add(block);
    while (group.blocks.size() != most) {
      // The one that covers it most, or else the nearest.
      std::size_t nearest = blocks();
      float most_shared = -1;
      float least_measure = std::numeric_limits<float>::infinity();
      for (std::size_t b = 0; b != blocks(); ++b) {
        if (is_chosen_[b] || !are_of_a_kind(b, block)) continue;
        const float shared = boxes_.share_of(block, b);
        const float measure = boxes_.measure_of_both(block, b);
        if (shared < most_shared || (shared == most_shared && !(measure < least_measure))) continue;
        most_shared = shared;
        least_measure = measure;
        nearest = b;
      }
      if (nearest == blocks()) break;
      add(nearest);
    }
    upkeep_.sorted_last += bounds;
    return static_cast<double>(bounds);
  }

  const DynamicState<Bound>& old_;
  std::span<const Change<Bound>> changes_;
  Upkeep& upkeep_;
  const Kernels& kernels_;
  bool walks_blocks_;
  BlockBoxes boxes_;
  std::vector<BlockStep> steps_;
  std::vector<std::uint32_t> arrivals_;
  std::size_t moves_ = 0;
  std::size_t count_ = 0;
  std::vector<BlockStep> by_block_;
  std::vector<std::size_t> first_step_;
  std::vector<std::size_t> after_;
  std::vector<bool> is_chosen_;
  std::vector<SortedGroup> groups_;
};

}  // namespace shaftcull::kernel
