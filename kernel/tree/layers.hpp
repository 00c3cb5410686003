// SPDX-License-Identifier: MIT
/// The layers of a tree's bounds, and those below each node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tree/tree_array.hpp"

namespace shaftcull::kernel {

template <class Bound>
struct TreeLevels;

/// Layers in tree order, in whole words; what fills up the last word of a level is in no layer.
struct TreeLayers {
  TreeArray<std::uint32_t> leaves;  ///< empty for a tree without layers
  TreeArray<std::uint32_t> nodes;   ///< all layers of the bounds below a node, which lie as TreeLevels::nodes do

  // Of all bounds. Where those of single ones have changed, the first and the last may be too much, the second too
  // little.
  std::uint32_t of_any = 0;     ///< layers that some bound is in
  std::uint32_t of_all = 0;     ///< layers that every bound is in
  bool is_any_in_none = false;  ///< whether some bound is in no layer

  /// Of a dynamic tree, whose layers are in blocks: null if all bounds are in all layers.
  const std::uint32_t* const* blocks = nullptr;

  [[nodiscard]] bool exist() const noexcept { return !leaves.empty(); }

  /// Whether every bound is in one of the layers of `mask`. It may say no where that is so.
  [[nodiscard]] bool are_all_in(std::uint32_t mask) const noexcept {
    return (of_all & mask) != 0 || ((of_any & ~mask) == 0 && !is_any_in_none);
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return leaves.bytes() + nodes.bytes(); }
};

/// The layers of a tree whose bound with the user's index i has layers[i], one for each bound.
template <class Bound>
TreeLayers layers_of(const TreeLevels<Bound>& parts, std::span<const std::uint32_t> order,
                     std::span<const std::uint32_t> layers);

/// Changes those of one leaf, and of the nodes above it. O(levels).
template <class Bound>
void set_layers_of_leaf(TreeLevels<Bound>& parts, std::size_t leaf, std::uint32_t layers) noexcept;

/// Those of `parts` by the user's index, for another tree of the same bounds.
template <class Bound>
std::vector<std::uint32_t> layers_by_index(const TreeLevels<Bound>& parts, std::span<const std::uint32_t> order);

}  // namespace shaftcull::kernel
