// SPDX-License-Identifier: MIT
/// A tree from bounds.
#pragma once

#include "tree/parts.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {

/// Sorts the bounds of a source and fits nodes to them. Leaf p is bound order[p] of the source. Throws BadBound for the
/// first illegal bound.
template <class Bound, class Index, class Source>
TreeParts<Bound, Index> build(const Source& source);

/// The tree that build() makes of the same bounds in the user's order, whatever order they have in `parts`.
template <class Bound, class Index>
TreeParts<Bound, Index> rebuild(const TreeParts<Bound, Index>& parts);

}  // namespace shaftcull::kernel
