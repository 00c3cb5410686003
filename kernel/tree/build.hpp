/// A tree from bounds.
#pragma once

#include "tree/parts.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {

/// Sorts the bounds of a source (ViewSource, RecordSource), which are legal, and fits nodes to them. Leaves `order` so that leaf p
/// is bound order[p] of the source.
template <class Bound, class Source>
TreeParts<Bound> build(const Source& source);

}  // namespace shaftcull::kernel
