// SPDX-License-Identifier: MIT
/// Layers of bounds: those of trees are the C++ interface's, those of views and streams are kept here.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "arguments.hpp"
#include "ask.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::TriangleTree;

namespace {

/// Calls of_tree(tree) for a tree of boxes or spheres, and of_others(layers) for a view or stream. Bounds may be const.
template <class Handle, class OfTree, class OfOthers>
void use_layers(Handle* bounds, OfTree&& of_tree, OfOthers&& of_others) {
  std::visit(
      [&]<class Holder>(Holder& holder) {
        if constexpr (requires { holder.has_layers(); }) {
          of_tree(holder);
        } else if constexpr (std::is_same_v<std::remove_const_t<Holder>, TriangleTree>) {
          refuse("bounds are " + name_of(*bounds) +
                 ", which has no layers; a view or stream of triangles may have some");
        } else {
          of_others(bounds->layers);
        }
      },
      given(bounds, "bounds").holder);
}

/// Puts bounds with these indices into other layers.
void set_some(std::vector<std::uint32_t>& all, std::span<const std::uint32_t> indices,
              std::span<const std::uint32_t> layers) {
  if (indices.empty()) return;
  if (all.empty()) refuse("bounds have no layers; shaftcull_bounds_set_layers() gives all of them some");
  for (std::size_t i = 0; i != indices.size(); ++i) {
    if (indices[i] >= all.size()) {
      refuse("indices[" + std::to_string(i) + "] = " + std::to_string(indices[i]) +
             " is not below the number of bounds that have layers, " + std::to_string(all.size()));
    }
  }
  for (std::size_t i = 0; i != indices.size(); ++i) all[indices[i]] = layers[i];
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_bounds_set_layers(shaftcull_bounds* bounds, const uint32_t* layers, uint64_t count) {
  return guarded([&] {
    const std::span<const uint32_t> from = as_span(layers, count, "layers");
    use_layers(
        bounds, [from](auto& tree) { tree.set_layers(from); },
        [from, bounds](std::vector<std::uint32_t>& all) {
          const std::size_t size = bounds_of(bounds).size();
          if (from.size() != size) {
            refuse("layers of " + std::to_string(from.size()) + " bounds were given to " + name_of(*bounds) +
                   ", which has " + std::to_string(size) + "; give those of each");
          }
          all = std::vector<std::uint32_t>(from.begin(), from.end());  // which may be `all` itself
        });
  });
}

shaftcull_status shaftcull_bounds_set_layers_of(shaftcull_bounds* bounds, const uint32_t* indices,
                                                const uint32_t* layers, uint64_t count) {
  return guarded([&] {
    const std::span<const uint32_t> which = as_span(indices, count, "indices");
    const std::span<const uint32_t> from = as_span(layers, count, "layers");
    use_layers(
        bounds, [which, from](auto& tree) { tree.set_layers(which, from); },
        [which, from](std::vector<std::uint32_t>& all) { set_some(all, which, from); });
  });
}

shaftcull_status shaftcull_bounds_clear_layers(shaftcull_bounds* bounds) {
  return guarded([&] {
    use_layers(
        bounds, [](auto& tree) { tree.clear_layers(); },
        [](std::vector<std::uint32_t>& all) { std::vector<std::uint32_t>().swap(all); });
  });
}

shaftcull_status shaftcull_bounds_layers(const shaftcull_bounds* bounds, const uint32_t** layers) {
  return guarded([&] {
    const uint32_t*& out = given(layers, "layers");
    const auto first_of = [&out](std::span<const uint32_t> all) { out = all.empty() ? nullptr : all.data(); };
    use_layers(
        bounds, [&](const auto& tree) { first_of(tree.layers()); },
        [&](const std::vector<std::uint32_t>& all) { first_of(all); });
  });
}

}  // extern "C"
