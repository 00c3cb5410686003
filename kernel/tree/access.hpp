// SPDX-License-Identifier: MIT
/// Access to the parts of a bounds tree, which are private in the public class.
#pragma once

#include <memory>
#include <utility>

#include "tree/parts.hpp"

namespace shaftcull {

template <class Bound, BoundIndex Index>
struct BoundsTree<Bound, Index>::Parts : kernel::TreeParts<Bound, Index> {};

struct TreeAccess {
  /// Null for a tree that was never given any bounds.
  template <class Bound, class Index>
  [[nodiscard]] static const kernel::TreeParts<Bound, Index>* parts(const BoundsTree<Bound, Index>& tree) noexcept {
    return tree.parts_.get();
  }
  template <class Bound, class Index>
  [[nodiscard]] static kernel::TreeParts<Bound, Index>* parts(BoundsTree<Bound, Index>& tree) noexcept {
    return tree.parts_.get();
  }
  template <class Bound, class Index>
  [[nodiscard]] static BoundsTree<Bound, Index> tree_of(kernel::TreeParts<Bound, Index> parts) {
    using Parts = typename BoundsTree<Bound, Index>::Parts;
    BoundsTree<Bound, Index> tree;
    tree.parts_ = std::make_unique<Parts>(Parts{std::move(parts)});
    return tree;
  }
};

}  // namespace shaftcull
