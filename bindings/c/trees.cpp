// SPDX-License-Identifier: MIT
#include <concepts>
#include <span>
#include <string>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::BoundsTree;
using shaftcull::Box;
using shaftcull::Sphere;
using shaftcull::TriangleTree;

namespace {

/// A tree of boxes or spheres.
template <class Holder>
concept Tree = requires(const Holder& holder) {
  holder.needs_refit();
};
/// One with indices of this width.
template <class Holder, class Index>
concept TreeOf = Tree<Holder> && std::same_as < std::span<const Index>,
decltype(std::declval<const Holder&>().order()) > ;

/// Makes a tree of boxes or spheres; false if the source is of neither.
template <class Index>
bool make_tree(const Source& source, shaftcull_bounds*& out) {
  using Boxes = BoundsTree<Box, Index>;
  using Spheres = BoundsTree<Sphere, Index>;
  return use_source(
      source, [&out]<class Records>(const Records& records) requires(std::is_constructible_v<Boxes, const Records&> ||
                                                                     std::is_constructible_v<Spheres, const Records&>) {
        if constexpr (std::is_constructible_v<Boxes, const Records&>) {
          out = new shaftcull_bounds{Boxes(records)};
        } else {
          out = new shaftcull_bounds{Spheres(records)};
        }
      });
}

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

template <class Index>
constexpr const char* of_index = sizeof(Index) == 4
                                     ? "a tree of boxes or spheres with 32-bit indices (the call ending in 64 takes "
                                       "others)"
                                     : "a tree of boxes or spheres with 64-bit indices (the call without 64 takes "
                                       "others)";

/// update() by a source: of all bounds, or of those with some indices.
template <class Holder, class... Indices>
void update(Holder& tree, const shaftcull_source* source, const Indices&... indices) {
  const bool fits = use_source(
      as_source(source, "source"), [&](const auto& records) requires requires { tree.update(indices..., records); } {
        tree.update(indices..., records);
      });
  if (!fits) refuse("source is not of the tree's kind of bounds");
}

template <class Index>
shaftcull_status update_some(shaftcull_bounds* tree, const Index* indices, std::uint64_t count,
                             const shaftcull_source* source) noexcept {
  return guarded([&] {
    use_tree(tree, of_index<Index>,
             [&](TreeOf<Index> auto& bounds) { update(bounds, source, as_span(indices, count, "indices")); });
  });
}

template <class Index>
shaftcull_status set_layers_of(shaftcull_bounds* tree, const Index* indices, const uint32_t* layers,
                               std::uint64_t count) noexcept {
  return guarded([&] {
    use_tree(tree, of_index<Index>, [&](TreeOf<Index> auto& bounds) {
      bounds.set_layers(as_span(indices, count, "indices"), as_span(layers, count, "layers"));
    });
  });
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_tree_create(const shaftcull_source* source, uint32_t index_bits, shaftcull_bounds** tree) {
  return guarded([&] {
    shaftcull_bounds*& out = given(tree, "tree");
    if (index_bits != 32 && index_bits != 64) {
      refuse("index_bits = " + std::to_string(index_bits) + " is neither 32 nor 64");
    }
    const Source from = as_source(source, "source");
    if (index_bits == 32 ? make_tree<std::uint32_t>(from, out) : make_tree<std::uint64_t>(from, out)) return;
    if (index_bits != 32) refuse("index_bits = 64; a tree of triangles has indices of 32 bits");
    (void)use_source(
        from, [&]<class Records>(const Records& records) requires(
                  std::is_constructible_v<TriangleTree, const Records&>) {
          out = new shaftcull_bounds{TriangleTree(records)};
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
        tree, "a tree with 32-bit indices",
        [&](const auto& bounds) requires(std::same_as<std::span<const std::uint32_t>, decltype(bounds.order())>) {
          out = bounds.order().data();
        });
  });
}

shaftcull_status shaftcull_tree_order64(const shaftcull_bounds* tree, const uint64_t** order) {
  return guarded([&] {
    const uint64_t*& out = given(order, "order");
    use_tree(tree, of_index<std::uint64_t>,
             [&](const TreeOf<std::uint64_t> auto& bounds) { out = bounds.order().data(); });
  });
}

shaftcull_status shaftcull_tree_update(shaftcull_bounds* tree, const shaftcull_source* source) {
  return guarded([&] { use_tree(tree, of_bounds, [&](Tree auto& bounds) { update(bounds, source); }); });
}

shaftcull_status shaftcull_tree_update_some(shaftcull_bounds* tree, const uint32_t* indices, uint64_t count,
                                            const shaftcull_source* source) {
  return update_some(tree, indices, count, source);
}

shaftcull_status shaftcull_tree_update_some64(shaftcull_bounds* tree, const uint64_t* indices, uint64_t count,
                                              const shaftcull_source* source) {
  return update_some(tree, indices, count, source);
}

shaftcull_status shaftcull_tree_refit(shaftcull_bounds* tree) {
  return guarded([&] { use_tree(tree, of_bounds, [](Tree auto& bounds) { bounds.refit(); }); });
}

shaftcull_status shaftcull_tree_rebuild(shaftcull_bounds* tree) {
  return guarded([&] { use_tree(tree, of_bounds, [](Tree auto& bounds) { bounds.rebuild(); }); });
}

shaftcull_status shaftcull_tree_renumber(shaftcull_bounds* tree) {
  return guarded([&] { use_tree(tree, of_bounds, [](Tree auto& bounds) { bounds.renumber(); }); });
}

shaftcull_status shaftcull_tree_growth(const shaftcull_bounds* tree, double* growth) {
  return guarded([&] {
    double& out = given(growth, "growth");
    use_tree(tree, of_bounds, [&](const Tree auto& bounds) { out = bounds.growth(); });
  });
}

shaftcull_status shaftcull_tree_set_layers(shaftcull_bounds* tree, const uint32_t* layers, uint64_t count) {
  return guarded([&] {
    use_tree(tree, of_bounds, [&](Tree auto& bounds) { bounds.set_layers(as_span(layers, count, "layers")); });
  });
}

shaftcull_status shaftcull_tree_set_layers_of(shaftcull_bounds* tree, const uint32_t* indices, const uint32_t* layers,
                                              uint64_t count) {
  return set_layers_of(tree, indices, layers, count);
}

shaftcull_status shaftcull_tree_set_layers_of64(shaftcull_bounds* tree, const uint64_t* indices, const uint32_t* layers,
                                                uint64_t count) {
  return set_layers_of(tree, indices, layers, count);
}

shaftcull_status shaftcull_tree_clear_layers(shaftcull_bounds* tree) {
  return guarded([&] { use_tree(tree, of_bounds, [](Tree auto& bounds) { bounds.clear_layers(); }); });
}

shaftcull_status shaftcull_tree_layers(const shaftcull_bounds* tree, const uint32_t** layers) {
  return guarded([&] {
    const uint32_t*& out = given(layers, "layers");
    use_tree(tree, of_bounds,
             [&](const Tree auto& bounds) { out = bounds.layers().empty() ? nullptr : bounds.layers().data(); });
  });
}

}  // extern "C"
