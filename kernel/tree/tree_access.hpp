// SPDX-License-Identifier: MIT
/// Access to the parts of a bounds tree, which are private in the public class.
#pragma once

#include <memory>
#include <utility>

#include "tree/parts.hpp"

namespace shaftcull {

template <class Bound>
struct BoundsTree<Bound>::Parts : kernel::TreeParts<Bound> {};

struct TreeAccess {
  /// Null for a tree that was never given any bounds.
  template <class Bound>
  [[nodiscard]] static const kernel::TreeParts<Bound>* parts(const BoundsTree<Bound>& tree) noexcept {
    return tree.parts_.get();
  }
  template <class Bound>
  [[nodiscard]] static kernel::TreeParts<Bound>* parts(BoundsTree<Bound>& tree) noexcept {
    return tree.parts_.get();
  }
  template <class Bound>
  [[nodiscard]] static BoundsTree<Bound> tree_of(kernel::TreeParts<Bound> parts) {
    using Parts = typename BoundsTree<Bound>::Parts;
    BoundsTree<Bound> tree;
    tree.parts_ = std::make_unique<Parts>(Parts{std::move(parts)});
    return tree;
  }
};

}  // namespace shaftcull
