// SPDX-License-Identifier: MIT
#include "shaftcull/dynamic_tree.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "dynamic/changes.hpp"
#include "dynamic/commit.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/prefetch.hpp"
#include "support/text.hpp"
#include "support/threads.hpp"
#include "tree/source.hpp"

namespace shaftcull {
namespace {

using kernel::BlockSize;
using kernel::Change;
using kernel::Slot;

/// A bound as streams have it.
template <class Bound>
struct Row {
  float value[kernel::rows_of<Bound>];
};
Row<Box> row_of(const Box& box) noexcept {
  return {{box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]}};
}
Row<Sphere> row_of(const Sphere& sphere) noexcept {
  return {{sphere.centre[0], sphere.centre[1], sphere.centre[2], sphere.radius}};
}
Box bound_of(const float (&row)[6]) noexcept { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}}; }
Sphere bound_of(const float (&row)[4]) noexcept { return {{row[0], row[1], row[2]}, row[3]}; }

Box moved_by(const Box& box, const Vec3& by) noexcept {
  return {{box.lo[0] + by[0], box.lo[1] + by[1], box.lo[2] + by[2]},
          {box.hi[0] + by[0], box.hi[1] + by[1], box.hi[2] + by[2]}};
}
Sphere moved_by(const Sphere& sphere, const Vec3& by) noexcept {
  return {{sphere.centre[0] + by[0], sphere.centre[1] + by[1], sphere.centre[2] + by[2]}, sphere.radius};
}

/// Whether what was finite still is, and nothing has become NaN.
template <std::size_t rows>
bool is_displaced(const float (&before)[rows], const float (&after)[rows]) noexcept {
  for (std::size_t r = 0; r != rows; ++r) {
    if (after[r] != after[r] || (std::isfinite(before[r]) && !std::isfinite(after[r]))) return false;
  }
  return true;
}

/// Throws BadBound for the first illegal bound.
template <class Bound>
void require_legal(std::span<const Bound> bounds) {
  const auto records = kernel::required_records(bounds, kernel::bounds_noun<ViewOf<Bound>>);
  kernel::in_float_environment([&] {
    if (bounds.size() == 1 && kernel::ReaderOf<Bound>::is_clearly_legal(row_of(bounds[0]).value)) return;
    kernel::require_legal<Bound>(kernel::RecordSource<Bound>(records));
  });
}

void require_sizes(const char* call, const char* one, std::size_t size, const char* other, std::size_t other_size) {
  if (size == other_size) return;
  kernel::fail(InvalidArgument(std::string(call) + "() got " + std::to_string(size) + " " + one + " and " +
                               std::to_string(other_size) + " " + other + "; give one for each"));
}

/// Refuses an id, called `name` in the message, of a tree that has used so many indices.
[[noreturn]] void refuse(BoundId id, const std::string& name, std::size_t indices) {
  kernel::fail(InvalidArgument(name + ", index " + std::to_string(id.index) + " of generation " +
                               std::to_string(id.generation) +
                               (id.index < indices ? ", was erased" : ", is no id of this tree")));
}

constexpr std::size_t few_changes = 1024;
constexpr std::size_t most_bounds = std::size_t{1} << 29U;

}  // namespace

template <class Bound>
TreeSnapshot<Bound>::TreeSnapshot() noexcept = default;
template <class Bound>
TreeSnapshot<Bound>::TreeSnapshot(const TreeSnapshot& other) noexcept : state_(other.state_) {
  if (state_ != nullptr) state_->add_owner();
}
template <class Bound>
TreeSnapshot<Bound>& TreeSnapshot<Bound>::operator=(const TreeSnapshot& other) noexcept {
  TreeSnapshot copy(other);
  std::swap(state_, copy.state_);
  return *this;
}
template <class Bound>
TreeSnapshot<Bound>::TreeSnapshot(TreeSnapshot&& other) noexcept : state_(std::exchange(other.state_, nullptr)) {}
template <class Bound>
TreeSnapshot<Bound>& TreeSnapshot<Bound>::operator=(TreeSnapshot&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}
template <class Bound>
TreeSnapshot<Bound>::~TreeSnapshot() {
  if (state_ != nullptr && state_->remove_owner()) delete state_;
}

template <class Bound>
std::size_t TreeSnapshot<Bound>::count() const noexcept {
  return state_ == nullptr ? 0 : state_->count;
}
template <class Bound>
std::size_t TreeSnapshot<Bound>::index_end() const noexcept {
  return state_ == nullptr ? 0 : state_->index_end;
}
template <class Bound>
bool TreeSnapshot<Bound>::has(std::uint32_t index) const noexcept {
  return state_ != nullptr && state_->has(index);
}
template <class Bound>
Bound TreeSnapshot<Bound>::operator[](std::uint32_t index) const {
  if (!has(index)) kernel::fail(InvalidArgument("no bound has index " + std::to_string(index)));
  float row[kernel::rows_of<Bound>];
  state_->read(index, row);
  return bound_of(row);
}
template <class Bound>
Box TreeSnapshot<Bound>::box() const noexcept {
  return kernel::in_float_environment(
      [&] { return kernel::box_around<Bound>(DynamicAccess::parts(*this), kernel::active_kernels()); });
}

template <class Bound>
struct DynamicTree<Bound>::Writer {
  Writer() : committed(DynamicAccess::snapshot_of<Bound>(kernel::empty_state<Bound>())) {}

  std::vector<Slot> slots;
  std::vector<std::uint32_t> free;  ///< indices that can be used again
  std::vector<Change<Bound>> changes;
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
      if (!has(ids[i])) refuse(ids[i], std::string(call) + "(): ids[" + std::to_string(i) + "]", slots.size());
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
  Change<Bound>& change_of(std::uint32_t index) noexcept {
    Slot& slot = slots[index];
    if (slot.change != 0) return changes[slot.change - 1];
    Change<Bound>& change = changes.emplace_back();
    slot.change = static_cast<std::uint32_t>(changes.size()) & 0x7FFFFFFFU;
    change.index = index;
    change.layers = all_layers;
    change.has_bound = false;
    return change;
  }
  void set(Change<Bound>& change, const Bound& bound) noexcept {
    const Row<Bound> row = row_of(bound);
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
    Change<Bound>& change = change_of(index);
    set(change, bound);
    change.layers = layers_of_bound;
    change.has_bound = true;
    layers = layers || layers_of_bound != all_layers;
    ++count;
    return {index, slots[index].generation};
  }
  void move(std::uint32_t index, const Bound& bound) noexcept {
    Change<Bound>& change = change_of(index);
    if (!change.has_bound && state().has_layers) change.layers = state().layers_of(index);
    change.has_bound = true;
    set(change, bound);
  }
  void set_layers(std::uint32_t index, std::uint32_t layers_of_bound) noexcept {
    Change<Bound>& change = change_of(index);
    if (!change.has_bound) state().read(index, change.bound);
    change.has_bound = true;
    change.layers = layers_of_bound;
    layers = layers || layers_of_bound != all_layers;
  }
  void erase(std::uint32_t index) noexcept {
    change_of(index).has_bound = false;
    slots[index].has_bound = 0;
    ++slots[index].generation;
    free.push_back(index);
    --count;
  }
  /// Makes all changes visible. `everything`: sorts all bounds.
  void commit_all(bool everything) {
    kernel::in_float_environment([&] { commit(everything); });
    for (const Change<Bound>& change : changes) slots[change.index].change = 0;
    const std::size_t now = changes.size();
    changes.clear();
    // Memory for more changes than usual is not kept.
    if (changes.capacity() > 4 * std::min(now, changes_before) + few_changes) changes = std::vector<Change<Bound>>();
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
    if (const std::uint32_t change = slots[index].change) return bound_of(changes[change - 1].bound);
    float row[kernel::rows_of<Bound>];
    state().read(index, row);
    return bound_of(row);
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
    return kernel::committed<Bound>(old, std::span<const Change<Bound>>(changes), slots.size(), layers, everything,
                                    upkeep);
  }
};

template <class Bound>
DynamicTree<Bound>::DynamicTree() noexcept = default;
template <class Bound>
auto DynamicTree<Bound>::writer() -> Writer& {
  if (!writer_) writer_ = std::make_unique<Writer>();
  return *writer_;
}
template <class Bound>
DynamicTree<Bound>::DynamicTree(DynamicTree&& other) noexcept = default;
template <class Bound>
DynamicTree<Bound>& DynamicTree<Bound>::operator=(DynamicTree&& other) noexcept = default;
template <class Bound>
DynamicTree<Bound>::~DynamicTree() = default;

template <class Bound>
BoundId DynamicTree<Bound>::insert(const Bound& bound, std::uint32_t layers) {
  BoundId id;
  insert({&bound, 1}, {&id, 1}, {&layers, 1});
  return id;
}

template <class Bound>
void DynamicTree<Bound>::insert(std::span<const Bound> bounds, std::span<BoundId> ids,
                                std::span<const std::uint32_t> layers) {
  Writer& writer = this->writer();
  require_sizes("insert", "bounds", bounds.size(), "ids", ids.size());
  if (!layers.empty()) require_sizes("insert", "bounds", bounds.size(), "layers", layers.size());
  kernel::require_memory("ids", ids, "ids");
  kernel::require_memory("layers", layers, "layers");
  require_legal(bounds);
  if (writer.count + bounds.size() > most_bounds) {
    kernel::fail(InvalidArgument("a dynamic tree of " + std::to_string(writer.count + bounds.size()) +
                                 " bounds: one can hold " + std::to_string(most_bounds)));
  }
  kernel::make_room(writer.slots, bounds.size() - std::min(bounds.size(), writer.free.size()));
  kernel::make_room(writer.changes, bounds.size());
  for (std::size_t i = 0; i != bounds.size(); ++i) {
    ids[i] = writer.insert(bounds[i], layers.empty() ? all_layers : layers[i]);
  }
}

template <class Bound>
void DynamicTree<Bound>::erase(BoundId id) {
  erase({&id, 1});
}

template <class Bound>
void DynamicTree<Bound>::erase(std::span<const BoundId> ids) {
  Writer& writer = this->writer();
  writer.require(ids, "erase");
  writer.require_each_once(ids, "erase");
  kernel::make_room(writer.changes, ids.size());
  kernel::make_room(writer.free, ids.size());
  for (const BoundId& id : ids) writer.erase(id.index);
}

template <class Bound>
void DynamicTree<Bound>::move(BoundId id, const Bound& bound) {
  move({&id, 1}, {&bound, 1});
}

template <class Bound>
void DynamicTree<Bound>::move(std::span<const BoundId> ids, std::span<const Bound> bounds) {
  Writer& writer = this->writer();
  require_sizes("move", "ids", ids.size(), "bounds", bounds.size());
  writer.require(ids, "move");
  require_legal(bounds);
  kernel::make_room(writer.changes, ids.size());
  for (std::size_t i = 0; i != ids.size(); ++i) writer.move(ids[i].index, bounds[i]);
}

template <class Bound>
void DynamicTree<Bound>::move_by(BoundId id, const Vec3& displacement) {
  move_by({&id, 1}, {&displacement, 1});
}

template <class Bound>
void DynamicTree<Bound>::move_by(std::span<const BoundId> ids, std::span<const Vec3> displacements) {
  Writer& writer = this->writer();
  require_sizes("move_by", "ids", ids.size(), "displacements", displacements.size());
  writer.require(ids, "move_by");
  writer.require_each_once(ids, "move_by");
  kernel::require_memory("displacements", displacements, "displacements");
  std::vector<Bound> moved(ids.size());
  kernel::in_float_environment([&] {
    for (std::size_t i = 0; i != ids.size(); ++i) {
      if (i + 2 * Writer::prefetched < ids.size()) writer.state().prefetch_place(ids[i + 2 * Writer::prefetched].index);
      if (i + Writer::prefetched < ids.size()) writer.state().prefetch(ids[i + Writer::prefetched].index);
      const Bound before = writer.bound(ids[i].index);
      moved[i] = moved_by(before, displacements[i]);
      if (!is_displaced(row_of(before).value, row_of(moved[i]).value)) {
        kernel::fail(BadBound(i, "move_by(): displacement " + std::to_string(i) + " moves the bound of index " +
                                     std::to_string(ids[i].index) + " beyond what floats hold, or is not a number"));
      }
    }
  });
  kernel::make_room(writer.changes, ids.size());
  for (std::size_t i = 0; i != ids.size(); ++i) writer.move(ids[i].index, moved[i]);
}

template <class Bound>
void DynamicTree<Bound>::set_layers(BoundId id, std::uint32_t layers) {
  Writer& writer = this->writer();
  writer.require({&id, 1}, "set_layers");
  kernel::make_room(writer.changes, 1);
  writer.set_layers(id.index, layers);
}

template <class Bound>
void DynamicTree<Bound>::commit() {
  if (writer_) writer_->commit_all(false);
}
template <class Bound>
void DynamicTree<Bound>::rebuild() {
  if (writer_) writer_->commit_all(true);
}

template <class Bound>
bool DynamicTree<Bound>::has(BoundId id) const noexcept {
  return writer_ && writer_->has(id);
}
template <class Bound>
BoundId DynamicTree<Bound>::id_of(std::uint32_t index) const noexcept {
  if (!writer_ || index >= writer_->slots.size() || writer_->slots[index].has_bound == 0) return {};
  return {index, writer_->slots[index].generation};
}
template <class Bound>
Bound DynamicTree<Bound>::operator[](BoundId id) const {
  if (!has(id)) refuse(id, "operator[](): the id", writer_ ? writer_->slots.size() : 0);
  return writer_->bound(id.index);
}
template <class Bound>
std::size_t DynamicTree<Bound>::count() const noexcept {
  return writer_ ? writer_->count : 0;
}
template <class Bound>
std::size_t DynamicTree<Bound>::memory_bytes() const noexcept {
  if (!writer_) return 0;
  const Writer& writer = *writer_;
  return sizeof writer + writer.slots.capacity() * sizeof(Slot) + writer.free.capacity() * sizeof(std::uint32_t) +
         writer.changes.capacity() * sizeof(Change<Bound>) + writer.state().bytes();
}

template <class Bound>
TreeSnapshot<Bound> DynamicTree<Bound>::snapshot() const {
  if (!writer_) return {};
  const kernel::Lock lock(writer_->mutex);
  return writer_->committed;
}
template <class Bound>
const TreeSnapshot<Bound>& DynamicTree<Bound>::committed() const noexcept {
  static const TreeSnapshot<Bound> nothing;
  return writer_ ? writer_->committed : nothing;
}

template <class Bound>
void DynamicTree<Bound>::set_upkeep(double sorted_per_change) {
  if (!(sorted_per_change >= 0) || !std::isfinite(sorted_per_change)) {
    kernel::fail(InvalidArgument("set_upkeep(): sorted_per_change is " + std::to_string(sorted_per_change) +
                                 "; it takes a finite number from 0 up"));
  }
  writer().upkeep.per_change = sorted_per_change;
}
template <class Bound>
TreeUpkeep DynamicTree<Bound>::upkeep() const noexcept {
  TreeUpkeep upkeep;
  if (!writer_) return upkeep;
  const Writer& writer = *writer_;
  upkeep.blocks = writer.state().blocks.size();
  upkeep.sorted_last = writer.upkeep.sorted_last;
  double growth = 0;
  for (const BlockSize& block : writer.state().size_of) {
    growth += static_cast<double>(block.growth);
    if (kernel::has_grown(block)) upkeep.waiting += block.count;
  }
  if (upkeep.blocks != 0) upkeep.growth = growth / static_cast<double>(upkeep.blocks);
  return upkeep;
}

template class TreeSnapshot<Box>;
template class TreeSnapshot<Sphere>;
template class DynamicTree<Box>;
template class DynamicTree<Sphere>;

}  // namespace shaftcull
