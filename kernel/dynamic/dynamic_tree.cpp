// SPDX-License-Identifier: MIT
#include "shaftcull/dynamic_tree.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dynamic/bound_rows.hpp"
#include "dynamic/changes.hpp"
#include "dynamic/commit.hpp"
#include "dynamic/writer.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/prefetch.hpp"
#include "tree/source.hpp"

namespace shaftcull {
namespace {

using kernel::BlockSize;
using kernel::Change;
using kernel::Slot;

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
    if (bounds.size() == 1 && kernel::ReaderOf<Bound>::is_clearly_legal(kernel::row_of(bounds[0]).value)) return;
    kernel::require_legal<Bound>(kernel::RecordSource<Bound>(records));
  });
}

void require_sizes(const char* call, const char* one, std::size_t size, const char* other, std::size_t other_size) {
  if (size == other_size) return;
  kernel::fail(InvalidArgument(std::string(call) + "() got " + std::to_string(size) + " " + one + " and " +
                               std::to_string(other_size) + " " + other + "; give one for each"));
}

constexpr std::size_t most_bounds = std::size_t{1} << 29U;

}  // namespace

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
      if (!is_displaced(kernel::row_of(before).value, kernel::row_of(moved[i]).value)) {
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
  if (!has(id))
    kernel::refuse(id, "operator[](): the id",
                   writer_ ? std::span<const Slot>(writer_->slots) : std::span<const Slot>());
  return writer_->bound(id.index);
}
template <class Bound>
std::size_t DynamicTree<Bound>::bound_count() const noexcept {
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
void DynamicTree<Bound>::set_sorted_per_change(double sorted_per_change) {
  if (!(sorted_per_change >= 0) || !std::isfinite(sorted_per_change)) {
    kernel::fail(InvalidArgument("set_sorted_per_change(): sorted_per_change is " + std::to_string(sorted_per_change) +
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
  if (upkeep.blocks != 0) upkeep.sah_ratio = growth / static_cast<double>(upkeep.blocks);
  return upkeep;
}

template class DynamicTree<Box>;
template class DynamicTree<Sphere>;

}  // namespace shaftcull
