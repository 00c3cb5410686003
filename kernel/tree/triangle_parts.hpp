// SPDX-License-Identifier: MIT
/// What a tree of triangles is made of.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
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
  std::size_t short_chunk = 0;     ///< the leaf of the chunk that may have fewer triangles than others
  std::size_t missing = 0;         ///< so many fewer
  double surface_when_built = -1;  ///< the sum of those of chunks' boxes; negative if it was not found yet

  /// The first triangle of a leaf of the tree of chunks, or what is behind the last one.
  [[nodiscard]] std::size_t first_of(std::size_t leaf) const noexcept {
    return leaf * TriangleTree::chunk_size - (leaf > short_chunk ? missing : 0);
  }
  /// The leaf that has a triangle.
  [[nodiscard]] std::size_t leaf_of(std::size_t triangle) const noexcept {
    return (triangle < first_of(short_chunk + 1) ? triangle : triangle + missing) / TriangleTree::chunk_size;
  }
  /// The triangles of `size` leaves from `leaf` on; there may be fewer leaves.
  [[nodiscard]] IndexRange triangles_of(std::size_t leaf, std::size_t size) const noexcept {
    const std::size_t first = first_of(leaf);
    return {first, first_of(std::min(leaf + size, chunks.size())) - first};
  }
};

/// A copy of the triangles, the one at order[i] at i.
[[nodiscard]] TriangleStream triangles_in_order(const TriangleView& triangles, std::span<const std::uint32_t> order);

/// Writes the box around a range of triangles, which is not empty, to position `at` of six streams.
inline void write_box_around(const TriangleView& triangles, const IndexRange& range, const std::array<float*, 6>& row,
                             std::size_t at) noexcept {
  for (std::size_t k = 0; k != 3; ++k) {
    float lo = triangles.stream[k][range.first];
    float hi = lo;
    for (std::size_t s = k; s < triangles.stream.size(); s += 3) {
      for (std::size_t i = range.first; i != range.end(); ++i) {
        lo = std::min(lo, triangles.stream[s][i]);
        hi = std::max(hi, triangles.stream[s][i]);
      }
    }
    row[k][at] = lo;
    row[k + 3][at] = hi;
  }
}

/// Sorts triangles: neighbours together, then chunks of them in the order of the tree of their boxes.
void build(TriangleParts& parts, const TriangleStream& triangles);

}  // namespace shaftcull::kernel

namespace shaftcull {

struct TriangleTree::Parts : kernel::TriangleParts {};

struct TriangleTreeAccess {
  [[nodiscard]] static const kernel::TriangleParts& parts(const TriangleTree& tree) noexcept {
    static const kernel::TriangleParts empty;
    return tree.parts_ ? *tree.parts_ : empty;
  }
  /// Null for a tree without triangles.
  [[nodiscard]] static kernel::TriangleParts* parts(TriangleTree& tree) noexcept { return tree.parts_.get(); }
  [[nodiscard]] static TriangleTree tree_of(kernel::TriangleParts parts) {
    TriangleTree tree;
    tree.parts_ = std::make_unique<TriangleTree::Parts>(TriangleTree::Parts{std::move(parts)});
    return tree;
  }
};

}  // namespace shaftcull
