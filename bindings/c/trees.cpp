// SPDX-License-Identifier: MIT
/// Trees whose bounds move. Those of bounds that come and go are in dynamic_trees.cpp, too.
#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;

namespace {

/// Calls use(tree) for a tree of the kinds that `takes` has, and refuses other bounds. They may be const.
template <template <class> class takes, class Bounds, class Use>
shaftcull_status use_tree_of(Bounds* bounds, Use&& use) noexcept {
  return guarded([&] {
    std::visit(
        [&]<class Holder>(Holder& holder) {
          if constexpr (takes<std::remove_const_t<Holder>>::value) {
            use(holder);
          } else {
            refuse("tree is " + name_of(*bounds) + "; this call takes a tree" +
                   (takes<shaftcull::DynamicBoxTree>::value ? "" : " that is not dynamic"));
          }
        },
        given(bounds, "tree").holder);
  });
}
template <class Holder>
using TakesChanging = std::bool_constant<ChangingTree<Holder>>;
template <class Holder>
using TakesAny = std::bool_constant<ChangingTree<Holder> || Dynamic<Holder>>;

template <class Bounds, class Use>
shaftcull_status use_tree(Bounds* bounds, Use&& use) noexcept {
  return use_tree_of<TakesChanging>(bounds, std::forward<Use>(use));
}
template <class Bounds, class Use>
shaftcull_status use_any_tree(Bounds* bounds, Use&& use) noexcept {
  return use_tree_of<TakesAny>(bounds, std::forward<Use>(use));
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

}  // extern "C"
