// SPDX-License-Identifier: MIT
/// Trees of boxes and spheres, whose bounds move.
#include <cstdint>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;

namespace {

/// Calls use(tree) if these are a tree of boxes or spheres, and refuses them otherwise. Bounds may be const.
template <class Bounds, class Use>
shaftcull_status use_tree(Bounds* bounds, Use&& use) noexcept {
  return guarded([&] {
    std::visit(
        [&]<class Holder>(Holder& holder) {
          if constexpr (ChangingTree<Holder>) {
            use(holder);
          } else {
            refuse("tree is " + name_of(*bounds) + "; this call takes a tree of boxes or spheres");
          }
        },
        given(bounds, "tree").holder);
  });
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
  return use_tree(tree, [](auto& bounds) { bounds.rebuild(); });
}

shaftcull_status shaftcull_tree_reorder(shaftcull_bounds* tree) {
  return use_tree(tree, [](auto& bounds) { bounds.reorder(); });
}

shaftcull_status shaftcull_tree_sah_ratio(const shaftcull_bounds* tree, double* sah_ratio) {
  return use_tree(tree, [&](const auto& bounds) { given(sah_ratio, "sah_ratio") = bounds.sah_ratio(); });
}

}  // extern "C"
