// SPDX-License-Identifier: MIT
/// Lists that the library allocates.
#pragma once

#include <utility>

#include "arguments.hpp"

namespace shaftcull::binding {

/// Calls use(lists) with lists of indices of either width; refuses those of ranges.
template <class Use>
void use_index_lists(shaftcull_lists* lists, Use&& use) {
  std::visit(
      [&]<class Lists>(Lists& out) {
        if constexpr (std::is_same_v<Lists, RangeLists>) {
          refuse("lists are of leaf ranges; this call fills lists of indices");
        } else {
          use(out);
        }
      },
      given(lists, "lists").lists);
}

/// Replaces lists of ranges by those that a tree gave.
template <class Index>
[[nodiscard]] RangeLists from_range_lists(LeafRangeListsOf<Index>&& lists) {
  RangeLists out;
  out.offsets = std::move(lists.offsets);
  out.ranges.reserve(lists.ranges.size());
  for (const LeafRangeOf<Index>& range : lists.ranges) out.ranges.push_back({range.first, range.size});
  return out;
}

}  // namespace shaftcull::binding
