// SPDX-License-Identifier: MIT
/// Formation by search: compares the colours of all pairs of faces (Listing 1 of the paper).
#pragma once

#include "formation/rule.hpp"

namespace shaftcull::kernel {

/// The edges that need a joining plane, in the order of box_edges.
[[nodiscard]] JoinedEdges search_edges(const Faces6& a, const Faces6& b) noexcept;

}  // namespace shaftcull::kernel
