// SPDX-License-Identifier: MIT
/// A tree from bounds.
#pragma once

#include <cstddef>

#include "support/index_range.hpp"
#include "tree/parts.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {

/// Which trees are built by regions (tree/regions.hpp), and how large those are. The tree is the same with any of them.
struct RegionSizes {
  std::size_t fewest_bounds = std::size_t{1} << 21U;    ///< of a tree that is built by regions
  std::size_t most_in_region = std::size_t{1} << 18U;   ///< 16 MiB of scratch memory
  std::size_t least_in_region = std::size_t{1} << 14U;  ///< where threads are many, regions are smaller, down to this
};

/// Sorts the bounds of a source and fits nodes to them. Leaf p is bound order[p] of the source. Throws BadBound for the
/// first illegal bound.
template <class Bound, class Source>
TreeParts<Bound> build(const Source& source, const RegionSizes& sizes = {});

/// The tree that build() makes of the same bounds in the user's order, whatever order they have in `parts`.
template <class Bound>
TreeParts<Bound> rebuild(const TreeParts<Bound>& parts, const RegionSizes& sizes = {});

/// Finds the least index of each word of some leaves: whole words, but for the tree's last one.
template <class Bound>
void find_least_indices(TreeParts<Bound>& parts, const IndexRange& leaves) noexcept;

}  // namespace shaftcull::kernel
