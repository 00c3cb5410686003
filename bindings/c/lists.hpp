// SPDX-License-Identifier: MIT
/// Lists that the library allocates.
#pragma once

#include <utility>
#include <variant>

#include "arguments.hpp"
#include "results.hpp"

namespace shaftcull::binding {

/// Lists of indices; refuses those of ranges.
[[nodiscard]] inline IndexLists& index_lists_of(shaftcull_lists* lists) {
  auto* const indices = std::get_if<IndexLists>(&given(lists, "lists").lists);
  if (indices == nullptr) {
    refuse("lists are of leaf ranges; this call fills lists of indices (SHAFTCULL_LISTS_OF_INDICES)");
  }
  return *indices;
}

/// Replaces lists of ranges by those that a tree gave.
[[nodiscard]] inline RangeLists from_range_lists(LeafRangeLists&& lists) {
  RangeLists out;
  out.offsets = std::move(lists.offsets);
  out.ranges.reserve(lists.ranges.size());
  for (const LeafRange& range : lists.ranges) out.ranges.push_back(from_range(range));
  return out;
}

}  // namespace shaftcull::binding
