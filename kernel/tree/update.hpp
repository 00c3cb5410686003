// SPDX-License-Identifier: MIT
/// New values for the bounds of a tree.
#pragma once

#include <span>

#include "tree/parts.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {

/// Gives every leaf its value in `source` and fits the nodes, in one parallel pass. Throws as BoundsTree::update().
template <class Bound, class Source>
void update_all(TreeParts<Bound>& parts, const Source& source);

/// Gives the leaves of `indices` their values in `source`, and marks the words that they are in. Throws likewise.
template <class Bound, class Source>
void update_some(TreeParts<Bound>& parts, std::span<const std::uint32_t> indices, const Source& source);

}  // namespace shaftcull::kernel
