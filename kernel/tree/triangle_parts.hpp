// SPDX-License-Identifier: MIT
/// What a tree of triangles is made of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"
#include "support/index_range.hpp"
#include "tree/leaf_places.hpp"
#include "tree/tree_array.hpp"

namespace shaftcull::kernel {

/// What a TriangleTree holds.
struct TriangleParts {
  TriangleStream triangles;        ///< chunk after chunk, in the tree order of their boxes
  TreeArray<std::uint32_t> order;  ///< triangle → the user's index
  LeafPlaces places;               ///< the user's index → triangle
  BoxTree chunks;
  std::size_t short_chunk = 0;  ///< the leaf of the chunk that may have fewer triangles than others
  std::size_t missing = 0;      ///< so many fewer

  /// The first triangle of a leaf of the tree of chunks, or what is behind the last one.
  [[nodiscard]] std::size_t first_of(std::size_t leaf) const noexcept {
    return leaf * TriangleTree::chunk_size - (leaf > short_chunk ? missing : 0);
  }
  /// The triangles of `size` leaves from `leaf` on; there may be fewer leaves.
  [[nodiscard]] IndexRange triangles_of(std::size_t leaf, std::size_t size) const noexcept {
    const std::size_t first = first_of(leaf);
    return {first, first_of(std::min(leaf + size, chunks.size())) - first};
  }
};

}  // namespace shaftcull::kernel

namespace shaftcull {

struct TriangleTree::Parts : kernel::TriangleParts {};

struct TriangleTreeAccess {
  [[nodiscard]] static const kernel::TriangleParts& parts(const TriangleTree& tree) noexcept {
    static const kernel::TriangleParts empty;
    return tree.parts_ ? *tree.parts_ : empty;
  }
  [[nodiscard]] static TriangleTree tree_of(kernel::TriangleParts parts) {
    TriangleTree tree;
    tree.parts_ = std::make_unique<TriangleTree::Parts>(TriangleTree::Parts{std::move(parts)});
    return tree;
  }
};

}  // namespace shaftcull
