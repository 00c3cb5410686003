// SPDX-License-Identifier: MIT
/// Where bounds that the user names are.
#pragma once

#include <string>

#include "shaftcull/error.hpp"
#include "support/compiler.hpp"
#include "support/fail.hpp"
#include "support/prefetch.hpp"
#include "tree/access.hpp"

namespace shaftcull::kernel {

/// In a view: at themselves.
struct PositionInView {
  template <class Index>
  [[nodiscard]] Index operator()(Index index) const noexcept {
    return index;
  }
  template <class Index>
  void prefetch(Index /*index*/) const noexcept {}
};

/// Among the leaves of a tree.
template <class Index>
struct PositionInTree {
  const Index* place;

  [[nodiscard]] Index operator()(Index index) const noexcept {
    return place[index];  // NOLINT(clang-analyzer-core.NullDereference): null of a tree that has no index
  }
  SHAFTCULL_ALWAYS_INLINE void prefetch(Index index) const noexcept { prefetch_to_second_level(place + index, 1); }
};

/// Where the bounds of a tree are, which must not need a refit: nobody may ask for its bounds then, as with all
/// queries.
template <class Bound, class Index>
PositionInTree<Index> places_of(const BoundsTree<Bound, Index>& tree) {
  const TreeParts<Bound, Index>* const parts = TreeAccess::parts(tree);
  return {parts == nullptr ? nullptr : parts->places.of(parts->order)};
}

template <class Bound, class Index>
void require_refitted(const char* call, const BoundsTree<Bound, Index>& tree) {
  if (tree.needs_refit()) {
    kernel::fail(NeedsRefit(std::string(call) + " of a tree whose bounds were updated; call refit() first"));
  }
}

}  // namespace shaftcull::kernel
