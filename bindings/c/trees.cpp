// SPDX-License-Identifier: MIT
/// Trees whose bounds move, and dynamic trees, whose bounds also come and go.
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::BoundId;
using shaftcull::Box;
using shaftcull::DynamicBoxTree;
using shaftcull::DynamicSphereTree;
using shaftcull::DynamicTree;
using shaftcull::Sphere;
using shaftcull::StridedBoxes;
using shaftcull::StridedSpheres;

namespace {

/// Calls use(tree) for a tree of the kinds that `takes` has, which is what messages call `kind`, and refuses other
/// bounds. They may be const.
template <template <class> class takes, class Bounds, class Use>
shaftcull_status use_tree_of(Bounds* bounds, const char* kind, Use&& use) noexcept {
  return guarded([&] {
    std::visit(
        [&]<class Holder>(Holder& holder) {
          if constexpr (takes<std::remove_const_t<Holder>>::value) {
            use(holder);
          } else {
            refuse("tree is " + name_of(*bounds) + "; this call takes " + kind);
          }
        },
        given(bounds, "tree").holder);
  });
}
template <class Holder>
using TakesChanging = std::bool_constant<ChangingTree<Holder>>;
template <class Holder>
using TakesDynamic = std::bool_constant<Dynamic<Holder>>;
template <class Holder>
using TakesAny = std::bool_constant<ChangingTree<Holder> || Dynamic<Holder>>;

template <class Bounds, class Use>
shaftcull_status use_tree(Bounds* bounds, Use&& use) noexcept {
  return use_tree_of<TakesChanging>(bounds, "a tree that is not dynamic", std::forward<Use>(use));
}
template <class Bounds, class Use>
shaftcull_status use_any_tree(Bounds* bounds, Use&& use) noexcept {
  return use_tree_of<TakesAny>(bounds, "a tree", std::forward<Use>(use));
}
template <class Bounds, class Use>
shaftcull_status use_dynamic_tree(Bounds* bounds, Use&& use) noexcept {
  return use_tree_of<TakesDynamic>(bounds, "a dynamic tree", std::forward<Use>(use));
}

/// Copies of the bounds of a source, which are checked when they are inserted.
std::vector<Box> bounds_in(const StridedBoxes& records) {
  std::vector<Box> boxes(as_count(records.count, sizeof(Box), "source"));
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    std::memcpy(&boxes[i].lo, static_cast<const std::byte*>(records.lo) + i * records.stride, sizeof boxes[i].lo);
    std::memcpy(&boxes[i].hi, static_cast<const std::byte*>(records.hi) + i * records.stride, sizeof boxes[i].hi);
  }
  return boxes;
}
std::vector<Sphere> bounds_in(const StridedSpheres& records) {
  std::vector<Sphere> spheres(as_count(records.count, sizeof(Sphere), "source"));
  for (std::size_t i = 0; i != spheres.size(); ++i) {
    Sphere& sphere = spheres[i];
    std::memcpy(&sphere.centre, static_cast<const std::byte*>(records.centre) + i * records.stride,
                sizeof sphere.centre);
    std::memcpy(&sphere.radius, static_cast<const std::byte*>(records.radius) + i * records.stride,
                sizeof sphere.radius);
  }
  return spheres;
}
template <class Bound>
std::vector<Bound> bounds_for(const DynamicTree<Bound>& /*tree*/, const shaftcull_source* source) {
  std::vector<Bound> bounds;
  const bool fits = use_source(
      as_source(source, "source"),
      [&bounds](const auto& records) requires requires {
        { bounds_in(records) } -> std::same_as<std::vector<Bound>>;
      } { bounds = bounds_in(records); });
  if (!fits) refuse("source is not an array of the tree's kind of bounds");
  return bounds;
}

BoundId as_id(const shaftcull_bound_id& id) noexcept { return {id.index, id.generation}; }
std::vector<BoundId> as_ids(const shaftcull_bound_id* ids, std::uint64_t count) {
  const std::span<const shaftcull_bound_id> given_ids = as_span(ids, count, "ids");
  std::vector<BoundId> all(given_ids.size());
  std::transform(given_ids.begin(), given_ids.end(), all.begin(), as_id);
  return all;
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_tree_update_some(shaftcull_bounds* tree, const uint32_t* indices, uint64_t count,
                                            const shaftcull_source* source) {
  return use_tree(tree, [&](auto& bounds) {
    const std::span<const uint32_t> which = as_span(indices, count, "indices");
    const bool fits = use_source(
        as_source(source, "source"), [&](const auto& records) requires requires { bounds.update(which, records); } {
          bounds.update(which, records);
        });
    if (!fits) refuse("source is not of the tree's kind of bounds");
  });
}

shaftcull_status shaftcull_tree_refit(shaftcull_bounds* tree) {
  return use_tree(tree, [](auto& bounds) { bounds.refit(); });
}

shaftcull_status shaftcull_tree_rebuild(shaftcull_bounds* tree) {
  return use_any_tree(tree, [](auto& bounds) { bounds.rebuild(); });
}

shaftcull_status shaftcull_tree_reorder(shaftcull_bounds* tree) {
  return use_tree(tree, [](auto& bounds) { bounds.reorder(); });
}

shaftcull_status shaftcull_tree_describe(const shaftcull_bounds* tree, shaftcull_tree_info* info) {
  return use_any_tree(tree, [&]<class Tree>(const Tree& bounds) {
    shaftcull_tree_info& out = given(info, "info");
    if constexpr (Dynamic<Tree>) {
      const shaftcull::TreeUpkeep upkeep = bounds.upkeep();
      out = {upkeep.sah_ratio, bounds.bound_count(), upkeep.blocks, upkeep.waiting, upkeep.sorted_last};
    } else {
      out = {bounds.sah_ratio(), bounds.size(), 0, 0, 0};
    }
  });
}

shaftcull_status shaftcull_dynamic_tree_create(shaftcull_bound_kind kind, double sorted_per_change,
                                               shaftcull_bounds** tree) {
  return guarded([&] {
    shaftcull_bounds*& out = given(tree, "tree");
    const auto create = [&](auto made) {
      made.set_sorted_per_change(sorted_per_change);
      out = new shaftcull_bounds{std::move(made)};
    };
    if (kind == SHAFTCULL_BOXES) return create(DynamicBoxTree());
    if (kind == SHAFTCULL_SPHERES) return create(DynamicSphereTree());
    refuse("kind = " + std::to_string(kind) + " is neither SHAFTCULL_BOXES nor SHAFTCULL_SPHERES");
  });
}

shaftcull_status shaftcull_dynamic_tree_insert(shaftcull_bounds* tree, const shaftcull_source* source,
                                               const uint32_t* layers, shaftcull_bound_id* ids) {
  return use_dynamic_tree(tree, [&](auto& dynamic) {
    const auto bounds = bounds_for(dynamic, source);
    const std::span<shaftcull_bound_id> out = as_span(ids, bounds.size(), "ids");
    std::vector<BoundId> inserted(bounds.size());
    dynamic.insert(std::span(bounds), inserted, as_span_if_given(layers, bounds.size(), "layers"));
    for (std::size_t i = 0; i != out.size(); ++i) out[i] = {inserted[i].index, inserted[i].generation};
  });
}

shaftcull_status shaftcull_dynamic_tree_erase(shaftcull_bounds* tree, const shaftcull_bound_id* ids, uint64_t count) {
  return use_dynamic_tree(tree, [&](auto& dynamic) { dynamic.erase(as_ids(ids, count)); });
}

shaftcull_status shaftcull_dynamic_tree_move(shaftcull_bounds* tree, const shaftcull_bound_id* ids, uint64_t count,
                                             const shaftcull_source* source, const float* displacements) {
  return use_dynamic_tree(tree, [&](auto& dynamic) {
    if ((source == nullptr) == (displacements == nullptr)) {
      refuse(std::string("source and displacements are ") + (source == nullptr ? "both NULL" : "both given") +
             "; one of them must be NULL");
    }
    const std::vector<BoundId> moved = as_ids(ids, count);
    if (source == nullptr) return dynamic.move_by(moved, as_vectors(displacements, count, "displacements"));
    const auto bounds = bounds_for(dynamic, source);
    dynamic.move(moved, std::span(bounds));
  });
}

shaftcull_status shaftcull_dynamic_tree_commit(shaftcull_bounds* tree) {
  return use_dynamic_tree(tree, [](auto& dynamic) { dynamic.commit(); });
}

shaftcull_status shaftcull_dynamic_tree_read(const shaftcull_bounds* tree, const shaftcull_bound_id* ids,
                                             uint64_t count, void* bounds) {
  return use_dynamic_tree(tree, [&]<class Bound>(const DynamicTree<Bound>& dynamic) {
    const std::span<const shaftcull_bound_id> read = as_span(ids, count, "ids");
    if (read.empty()) return;
    std::byte* const out = &given(static_cast<std::byte*>(bounds), "bounds");
    for (std::size_t i = 0; i != read.size(); ++i) {
      if (dynamic.has(as_id(read[i]))) continue;
      refuse("ids[" + std::to_string(i) + "], index " + std::to_string(read[i].index) + " of generation " +
             std::to_string(read[i].generation) + ", has no bound");
    }
    for (std::size_t i = 0; i != read.size(); ++i) {
      const Bound bound = dynamic[as_id(read[i])];
      std::memcpy(out + i * sizeof bound, &bound, sizeof bound);
    }
  });
}

}  // extern "C"
