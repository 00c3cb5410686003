// SPDX-License-Identifier: MIT
#include <cstdint>
#include <span>
#include <string>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::BoxTree;
using shaftcull::SphereTree;
using shaftcull::TriangleTree;

namespace {

/// A tree of boxes or spheres.
template <class Holder>
concept Tree = requires(const Holder& holder) {
  holder.needs_refit();
};

/// Calls use(tree) if these are a tree that it takes, and refuses them otherwise. Bounds may be const.
template <class Bounds, class Use>
void use_tree(Bounds* bounds, const char* takes, Use&& use) {
  std::visit(
      [&]<class Holder>(Holder& holder) {
        if constexpr (std::is_invocable_v<Use&, Holder&>) {
          use(holder);
        } else {
          refuse("tree is " + name_of(*bounds) + "; this call takes " + takes);
        }
      },
      given(bounds, "tree").holder);
}
constexpr const char* of_bounds = "a tree of boxes or spheres";

/// update() by a source: of all bounds, or of those with some indices.
template <class Holder, class... Indices>
void update(Holder& tree, const shaftcull_source* source, const Indices&... indices) {
  const bool fits = use_source(
      as_source(source, "source"), [&](const auto& records) requires requires { tree.update(indices..., records); } {
        tree.update(indices..., records);
      });
  if (!fits) refuse("source is not of the tree's kind of bounds");
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_tree_create(const shaftcull_source* source, shaftcull_bounds** tree) {
  return guarded([&] {
    shaftcull_bounds*& out = given(tree, "tree");
    (void)use_source(as_source(source, "source"), [&out]<class Records>(const Records& records) {
      if constexpr (std::is_constructible_v<BoxTree, const Records&>) {
        out = new shaftcull_bounds{BoxTree(records)};
      } else if constexpr (std::is_constructible_v<SphereTree, const Records&>) {
        out = new shaftcull_bounds{SphereTree(records)};
      } else {
        out = new shaftcull_bounds{TriangleTree(records)};
      }
    });
  });
}

shaftcull_status shaftcull_tree_box(const shaftcull_bounds* tree, shaftcull_box* box) {
  return guarded([&] {
    shaftcull_box& out = given(box, "box");
    use_tree(
        tree, "a tree", [&](const auto& bounds) requires requires { bounds.order(); } {
          out = converted<shaftcull_box>(bounds.box());
        });
  });
}

shaftcull_status shaftcull_tree_order(const shaftcull_bounds* tree, const uint32_t** order) {
  return guarded([&] {
    const uint32_t*& out = given(order, "order");
    use_tree(
        tree, "a tree", [&](const auto& bounds) requires requires { bounds.order(); } { out = bounds.order().data(); });
  });
}

shaftcull_status shaftcull_tree_update(shaftcull_bounds* tree, const shaftcull_source* source) {
  return guarded([&] { use_tree(tree, of_bounds, [&](Tree auto& bounds) { update(bounds, source); }); });
}

shaftcull_status shaftcull_tree_update_some(shaftcull_bounds* tree, const uint32_t* indices, uint64_t count,
                                            const shaftcull_source* source) {
  return guarded([&] {
    use_tree(tree, of_bounds, [&](Tree auto& bounds) { update(bounds, source, as_span(indices, count, "indices")); });
  });
}

shaftcull_status shaftcull_tree_refit(shaftcull_bounds* tree) {
  return guarded([&] { use_tree(tree, of_bounds, [](Tree auto& bounds) { bounds.refit(); }); });
}

shaftcull_status shaftcull_tree_rebuild(shaftcull_bounds* tree) {
  return guarded([&] { use_tree(tree, of_bounds, [](Tree auto& bounds) { bounds.rebuild(); }); });
}

shaftcull_status shaftcull_tree_renumber(shaftcull_bounds* tree) {
  return guarded([&] { use_tree(tree, of_bounds, [](Tree auto& bounds) { bounds.reorder(); }); });
}

shaftcull_status shaftcull_tree_sah_ratio(const shaftcull_bounds* tree, double* sah_ratio) {
  return guarded([&] {
    double& out = given(sah_ratio, "sah_ratio");
    use_tree(tree, of_bounds, [&](const Tree auto& bounds) { out = bounds.sah_ratio(); });
  });
}

}  // extern "C"
