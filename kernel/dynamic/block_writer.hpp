// SPDX-License-Identifier: MIT
/// Writes the changes of a commit into blocks.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dynamic/block_changes.hpp"
#include "dynamic/changes.hpp"
#include "dynamic/commit.hpp"
#include "dynamic/commit_plan.hpp"
#include "parallel/parallel.hpp"
#include "support/prefetch.hpp"

namespace shaftcull::kernel {

/// Calls write(i) for each i below `count`, in tasks. If tasks cannot be started, this thread makes the calls that are
/// left. `is_written` holds `count` zeros.
template <class Write>
void write_each(std::size_t count, bool in_tasks, std::vector<std::uint8_t>& is_written, Write&& write) noexcept {
  const auto write_one = [&](std::size_t i, std::size_t) {
    if (is_written[i] != 0) return;
    write(i);
    is_written[i] = 1;
  };
  if (in_tasks) {
#if defined(__cpp_exceptions)
    try {
      return parallel_for(count, 1, write_one);
    } catch (...) {  // oneTBB could not start its tasks
    }
#else
    return parallel_for(count, 1, write_one);
#endif
  }
  for (std::size_t i = 0; i != count; ++i) write_one(i, 0);
}

/// Makes the changes of a plan, block by block.
template <class Bound>
class BlockWriter {
 public:
  /// Refers to all arguments.
  BlockWriter(const CommitPlan<Bound>& plan, const Changes<Bound>& changes, const Kernels& kernels) noexcept
      : plan_(plan), changes_(changes.all), slots_(changes.slots), kernels_(kernels) {}

  /// Whether there is so much to write that tasks share it.
  [[nodiscard]] bool is_worth_tasks() const noexcept {
    constexpr std::size_t few_steps = 1024;
    return plan_.steps().size() >= few_steps || plan_.walks_blocks();
  }

  /// Makes the changes of the block that is at position `from`. Returns the words that were written, as bits.
  std::uint64_t write(LeafBlock<Bound>& leaves, std::size_t from, const PlaceWriter& places) const noexcept {
    const std::span<const BlockStep> steps = plan_.steps_of(from);
    BlockChanges<Bound> block(leaves, places, kernels_);
    for (const BlockStep& step : steps) {
      if (step.kind == BlockStep::erase) block.erase(step.leaf, changes_[step.change]);
    }
    if (plan_.walks_blocks()) {
      std::uint64_t taken[block_words];  // as they are now: bounds that go to another word are not visited again
      std::copy_n(leaves.taken, block_words, taken);
      for_each_changed(leaves, taken, [&](std::size_t leaf, const Change<Bound>& change) { block.move(leaf, change); });
    } else {
      constexpr std::size_t prefetched = 16;
      for (std::size_t i = 0; i != steps.size(); ++i) {
        if (i + prefetched < steps.size()) prefetch_change(steps[i + prefetched].change);
        if (steps[i].kind == BlockStep::move) block.move(steps[i].leaf, changes_[steps[i].change]);
      }
    }
    for (const BlockStep& step : steps) {
      if (step.kind == BlockStep::insert) block.insert(changes_[step.change]);
    }
    return block.finish();
  }

  /// Calls use(leaf, change) for each of these leaves whose bound has a change. Slots and changes are scattered in
  /// memory, so slots are prefetched two words ahead, and changes one word ahead. Prefetches are spread over the loop:
  /// processors drop some of many that come at once.
  template <class Use>
  void for_each_changed(const LeafBlock<Bound>& block, const std::uint64_t (&leaves)[block_words],
                        Use&& use) const noexcept {
    const auto slot = [this, order = block.order()](std::size_t leaf) -> const Slot& { return slots_[order[leaf]]; };
    for (std::size_t w = 0; w != block_words; ++w) {
      for (std::uint64_t left = leaves[w]; left != 0; left &= left - 1) {
        const std::size_t leaf = w * fanout + static_cast<std::size_t>(std::countr_zero(left));
        if (w + 2 < block_words) prefetch_to_second_level(&slot(leaf + 2 * fanout), 1);
        if (w + 1 < block_words) {
          if (const std::uint32_t soon = slot(leaf + fanout).change) prefetch_change(soon - 1);
        }
        if (const std::uint32_t change = slot(leaf).change) use(leaf, changes_[change - 1]);
      }
    }
  }

 private:
  /// The changes of a block are scattered in memory.
  SHAFTCULL_ALWAYS_INLINE void prefetch_change(std::uint32_t number) const noexcept {
    const Change<Bound>& soon = changes_[number];
    prefetch_to_second_level(&soon, 1);
  }

  const CommitPlan<Bound>& plan_;
  std::span<const Change<Bound>> changes_;
  std::span<const Slot> slots_;
  const Kernels& kernels_;
};

}  // namespace shaftcull::kernel
