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
  [[nodiscard]] std::uint32_t operator()(std::uint32_t index) const noexcept { return index; }
  void prefetch(std::uint32_t /*index*/) const noexcept {}
};

/// Among the leaves of a tree.
struct PositionInTree {
  const std::uint32_t* place;

  [[nodiscard]] std::uint32_t operator()(std::uint32_t index) const noexcept {
    return place[index];  // NOLINT(clang-analyzer-core.NullDereference): null of a tree that has no index
  }
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::uint32_t index) const noexcept {
    prefetch_to_second_level(place + index, 1);
  }
};

/// Where the bounds of a tree are, which must not need a refit: nobody may ask for its bounds then, as with all
/// queries.
template <class Bound>
PositionInTree places_of(const BoundsTree<Bound>& tree) {
  const TreeParts<Bound>* const parts = TreeAccess::parts(tree);
  return {parts == nullptr ? nullptr : parts->places.of(parts->order)};
}

template <class Bound>
void require_refitted(const char* call, const BoundsTree<Bound>& tree) {
  if (tree.needs_refit()) {
    kernel::fail(NeedsRefit(std::string(call) + " of a tree whose bounds were updated; call refit() first"));
  }
}

}  // namespace shaftcull::kernel
