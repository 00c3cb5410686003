// SPDX-License-Identifier: MIT
/// What a dynamic tree has besides its last state: ids, and changes that wait.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dynamic/bound_rows.hpp"
#include "dynamic/changes.hpp"
#include "dynamic/commit.hpp"
#include "shaftcull/dynamic_tree.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/prefetch.hpp"
#include "support/threads.hpp"
#include "tree/dynamic_access.hpp"

namespace shaftcull {
namespace kernel {

/// Refuses an id that has no bound, called `name` in the message.
[[noreturn]] inline void refuse(BoundId id, const std::string& name, std::span<const Slot> slots) {
  const bool was_there = id.index < slots.size() && id.generation < slots[id.index].generation;
  fail(InvalidArgument(name + ", index " + std::to_string(id.index) + " of generation " +
                       std::to_string(id.generation) + (was_there ? ", was erased" : ", is no id of this tree")));
}

}  // namespace kernel

template <class Bound>
struct DynamicTree<Bound>::Writer {
  Writer() : committed(DynamicAccess::snapshot_of<Bound>(kernel::empty_state<Bound>())) {}

  std::vector<kernel::Slot> slots;
  std::vector<std::uint32_t> free;  ///< indices that can be used again
  std::vector<kernel::Change<Bound>> changes;
  std::size_t changes_before = 0;  ///< that the last commit made
  std::size_t count = 0;
  bool layers = false;  ///< whether some bound was ever in other layers than all
  kernel::Upkeep upkeep;

  TreeSnapshot<Bound> committed;
  kernel::Mutex mutex;  ///< guards `committed`, and its state where that is changed

  [[nodiscard]] kernel::StateOf<Bound>& state() const noexcept { return *DynamicAccess::state(committed); }
  [[nodiscard]] bool has(BoundId id) const noexcept {
    return id.index < slots.size() && slots[id.index].has_bound != 0 && slots[id.index].generation == id.generation;
  }
  void require(std::span<const BoundId> ids, const char* call) const {
    kernel::require_memory("ids", ids, "ids");
    for (std::size_t i = 0; i != ids.size(); ++i) {
      if (i + prefetched < ids.size()) prefetch_slot(ids[i + prefetched]);
      if (!has(ids[i])) kernel::refuse(ids[i], std::string(call) + "(): ids[" + std::to_string(i) + "]", slots);
    }
  }
  void require_each_once(std::span<const BoundId> ids, const char* call) {
    std::size_t i = 0;
    for (; i != ids.size() && slots[ids[i].index].has_bound != 0; ++i) slots[ids[i].index].has_bound = 0;
    for (std::size_t j = 0; j != i; ++j) slots[ids[j].index].has_bound = 1;
    if (i == ids.size()) return;
    kernel::fail(InvalidArgument(std::string(call) + "(): ids[" + std::to_string(i) + "], index " +
                                 std::to_string(ids[i].index) + ", occurs twice; give each id once"));
  }
  /// Ids ahead whose slots are prefetched, and bounds: they are all over memory.
  static constexpr std::size_t prefetched = 16;
  void prefetch_slot(BoundId id) const noexcept {
    if (id.index < slots.size()) kernel::prefetch_to_second_level(&slots[id.index], 1);
  }

  /// What waits for an index; something new says that it has no bound. There is room for it.
  kernel::Change<Bound>& change_of(std::uint32_t index) noexcept {
    kernel::Slot& slot = slots[index];
    if (slot.change != 0) return changes[slot.change - 1];
    kernel::Change<Bound>& change = changes.emplace_back();
    slot.change = static_cast<std::uint32_t>(changes.size()) & 0x7FFFFFFFU;
    change.index = index & 0x7FFFFFFFU;
    change.layers = all_layers;
    change.has_bound = 0;
    return change;
  }
  void set(kernel::Change<Bound>& change, const Bound& bound) noexcept {
    const kernel::Row<Bound> row = kernel::row_of(bound);
    std::copy_n(row.value, kernel::rows_of<Bound>, change.bound);
  }

  BoundId insert(const Bound& bound, std::uint32_t layers_of_bound) noexcept {
    std::uint32_t index = 0;
    if (free.empty()) {
      index = static_cast<std::uint32_t>(slots.size());
      slots.emplace_back();
    } else {
      index = free.back();
      free.pop_back();
    }
    slots[index].has_bound = 1;
    kernel::Change<Bound>& change = change_of(index);
    set(change, bound);
    change.layers = layers_of_bound;
    change.has_bound = 1;
    layers = layers || layers_of_bound != all_layers;
    ++count;
    return {index, slots[index].generation};
  }
  void move(std::uint32_t index, const Bound& bound) noexcept {
    kernel::Change<Bound>& change = change_of(index);
    if (!change.has_bound && state().has_layers) change.layers = state().layers_of(index);
    change.has_bound = 1;
    set(change, bound);
  }
  void set_layers(std::uint32_t index, std::uint32_t layers_of_bound) noexcept {
    kernel::Change<Bound>& change = change_of(index);
    if (change.has_bound == 0) state().read(index, change.bound);
    change.has_bound = 1;
    change.layers = layers_of_bound;
    layers = layers || layers_of_bound != all_layers;
  }
  void erase(std::uint32_t index) noexcept {
    change_of(index).has_bound = 0;
    slots[index].has_bound = 0;
    ++slots[index].generation;
    free.push_back(index);
    --count;
  }
  /// Makes all changes visible. `everything`: sorts all bounds.
  void commit_all(bool everything) {
    kernel::in_float_environment([&] { commit(everything); });
    for (const kernel::Change<Bound>& change : changes) slots[change.index].change = 0;
    const std::size_t now = changes.size();
    changes.clear();
    // Memory for more changes than usual is not kept.
    constexpr std::size_t few_changes = 1024;
    if (changes.capacity() > 4 * std::min(now, changes_before) + few_changes)
      changes = std::vector<kernel::Change<Bound>>();
    changes_before = now;
  }
  /// Makes the state that has all changes. They stay.
  void commit(bool everything) {
    TreeSnapshot<Bound> before;
    {
      // A state that nobody else has is changed where it is: nobody can get it meanwhile.
      const kernel::Lock lock(mutex);
      if (state().has_one_owner()) {
        Kept old{committed, DynamicAccess::take(committed)};
        old.state = next_of(old.state, everything);
        return;
      }
      before = committed;
    }
    const kernel::Shared<kernel::StateOf<Bound>> old = DynamicAccess::take(before);
    TreeSnapshot<Bound> next = DynamicAccess::snapshot_of<Bound>(next_of(old, everything));
    const kernel::Lock lock(mutex);
    committed = std::move(next);
  }

  [[nodiscard]] Bound bound(std::uint32_t index) const noexcept {
    if (const std::uint32_t change = slots[index].change) return kernel::bound_of(changes[change - 1].bound);
    float row[kernel::rows_of<Bound>];
    state().read(index, row);
    return kernel::bound_of(row);
  }

 private:
  /// A state that is taken out of a snapshot, and put back at the end.
  struct Kept {
    TreeSnapshot<Bound>& snapshot;
    kernel::Shared<kernel::StateOf<Bound>> state;
    Kept(TreeSnapshot<Bound>& of, kernel::Shared<kernel::StateOf<Bound>> its_state) noexcept
        : snapshot(of), state(std::move(its_state)) {}
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;
    ~Kept() { snapshot = DynamicAccess::snapshot_of<Bound>(std::move(state)); }
  };
  [[nodiscard]] kernel::Shared<kernel::StateOf<Bound>> next_of(const kernel::Shared<kernel::StateOf<Bound>>& old,
                                                               bool everything) {
    return kernel::committed<Bound>(old, kernel::Changes<Bound>{changes, slots}, layers, everything, upkeep);
  }
};

}  // namespace shaftcull
