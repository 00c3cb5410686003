// SPDX-License-Identifier: MIT
#include "tree/layers.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "parallel/parallel.hpp"
#include "support/index_range.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {
namespace {

/// Leaves whose layers a task collects, from all over the user's memory.
constexpr std::size_t task_leaves = 16384;

std::uint32_t all_of_word(const std::uint32_t* layers) noexcept {
  return std::accumulate(layers, layers + fanout, std::uint32_t{0}, std::bit_or<>());
}

}  // namespace

template <class Bound>
TreeLayers layers_of(const TreeLevels<Bound>& parts, std::span<const std::uint32_t> order,
                     std::span<const std::uint32_t> layers) {
  TreeLayers result;
  result.leaves = {bit_words(parts.size) * fanout, 0U};
  result.nodes = {parts.nodes.size(), 0U};
  parallel_for(chunk_count(parts.size, task_leaves), 1, [&](std::size_t b, std::size_t) {
    const IndexRange block = chunk_at(parts.size, task_leaves, b);
    for (std::size_t p = block.first; p != block.end(); ++p) result.leaves[p] = layers[order[p]];
  });
  for (std::size_t k = 1; k < parts.levels; ++k) {
    const std::uint32_t* const below = k == 1 ? result.leaves.data() : result.nodes.data() + parts.level[k - 1].first;
    std::uint32_t* const here = result.nodes.data() + parts.level[k].first;
    for (std::size_t i = 0; i != parts.level[k].entries; ++i) here[i] = all_of_word(below + i * fanout);
  }
  result.of_any = std::accumulate(layers.begin(), layers.end(), std::uint32_t{0}, std::bit_or<>());
  result.of_all = std::accumulate(layers.begin(), layers.end(), ~std::uint32_t{0}, std::bit_and<>());
  result.is_any_in_none = std::find(layers.begin(), layers.end(), 0U) != layers.end();
  return result;
}

template <class Bound>
void set_layers_of_leaf(TreeLevels<Bound>& parts, std::size_t leaf, std::uint32_t layers) noexcept {
  TreeLayers& all = parts.layers;
  all.leaves[leaf] = layers;
  all.of_any |= layers;
  all.of_all &= layers;
  all.is_any_in_none |= layers == 0;
  const std::uint32_t* below = all.leaves.data();
  std::size_t entry = leaf;
  for (std::size_t k = 1; k < parts.levels; ++k) {
    entry /= fanout;
    std::uint32_t* const here = all.nodes.data() + parts.level[k].first;
    here[entry] = all_of_word(below + entry * fanout);
    below = here;
  }
}

template <class Bound>
std::vector<std::uint32_t> layers_by_index(const TreeLevels<Bound>& parts, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> layers(parts.size);
  for (std::size_t p = 0; p != parts.size; ++p) layers[order[p]] = parts.layers.leaves[p];
  return layers;
}

template void set_layers_of_leaf(TreeLevels<Box>&, std::size_t, std::uint32_t) noexcept;
template void set_layers_of_leaf(TreeLevels<Sphere>&, std::size_t, std::uint32_t) noexcept;
#define SHAFTCULL_LAYERS(Bound)                                                           \
  template TreeLayers layers_of(const TreeLevels<Bound>&, std::span<const std::uint32_t>, \
                                std::span<const std::uint32_t>);                          \
  template std::vector<std::uint32_t> layers_by_index(const TreeLevels<Bound>&, std::span<const std::uint32_t>);
SHAFTCULL_LAYERS(Box)
SHAFTCULL_LAYERS(Sphere)
#undef SHAFTCULL_LAYERS

}  // namespace shaftcull::kernel
