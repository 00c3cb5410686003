// SPDX-License-Identifier: MIT
/// What a bounds tree is made of: streams of leaves and of nodes, and nothing that points from one to the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/kernel_table.hpp"
#include "query/leaf_blocks.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"
#include "streams/stream_access.hpp"
#include "tree/layers.hpp"
#include "tree/leaf_places.hpp"
#include "tree/tree_array.hpp"

namespace shaftcull::kernel {

inline constexpr std::size_t fanout = 64;

/// A tree is not made narrower than this many words at the top: visiting them all costs less than one more level.
inline constexpr std::size_t top_words = 2;

/// What second-level caches hold. Prefetching leaves that one holds costs a walk a tenth, and gains nothing.
inline constexpr std::size_t second_level_bytes = std::size_t{2} << 20U;

/// Levels of a tree of 2³² − 1 bounds.
inline constexpr std::size_t most_levels = 6;

/// One level: level 0 is the leaves, entry i of another is the box around entries 64 i … of the one below.
struct TreeLevel {
  std::size_t entries = 0;
  std::size_t first = 0;  ///< where its entries begin in the streams of nodes: a multiple of 64. Not for level 0

  [[nodiscard]] std::size_t words() const noexcept { return bit_words(entries); }
};

/// Number of streams of a bound.
template <class Bound>
inline constexpr std::size_t rows_of = row_count<ViewOf<Bound>>;

/// Bounds in tree order and the nodes above them: all that a walk reads.
template <class Bound>
struct TreeLevels {
  std::size_t size = 0;
  std::array<TreeLevel, most_levels> level;
  std::size_t levels = 0;  ///< 0 for an empty tree

  StreamOf<ViewOf<Bound>> leaves;  ///< bounds in tree order
  BoxStream nodes;                 ///< boxes of all levels above the leaves, each level a whole number of words

  /// Bit i of word first / 64 + i / 64 of a level: something below entry i is empty, or padding, so that it is outside
  /// even where the box of the entry is inside.
  TreeArray<std::uint64_t> gaps;

  TreeLayers layers;

  /// Where the leaves of a dynamic tree are: its `leaves`, and the arrays of TreeParts, are empty.
  LeafBlocks blocks{};

  std::vector<std::uint64_t> dirty;  ///< bit i: a leaf under entry i of level 1 has changed; empty until then
  std::size_t dirty_words = 0;       ///< how many of those bits are set; as many as there are words, or more: see below
  double surface_when_built = 0;

  /// Counts every word of leaves as dirty, whatever the bits say, until fit_upper(). Who writes leaves in parallel does
  /// this first: an exception on the way then leaves a tree that asks for a refit.
  void mark_all_dirty() noexcept { dirty_words = bit_words(size); }

  /// Whether fitting all nodes in one pass is cheaper than fitting dirty ones entry by entry: from about one word in
  /// eight on.
  [[nodiscard]] bool are_many_dirty() const noexcept { return dirty_words > bit_words(size) / 8; }

  /// Whether the leaves are more than a second-level cache holds.
  [[nodiscard]] bool is_worth_prefetching() const noexcept {
    return rows_of<Bound> * sizeof(float) * level[0].entries > second_level_bytes;
  }

  /// A word of leaves, or some: from leaf `from` on. The tree's last word has padding behind its leaves.
  [[nodiscard]] ViewOf<Bound> leaf_words(std::size_t from, std::size_t words) const noexcept {
    return leaves.view().slice(from, words * fanout);
  }
  /// The streams of the leaves around `leaf`, and where it is in them.
  [[nodiscard]] const float* const* streams_at(std::size_t leaf) const noexcept {
    return blocks.exist() ? blocks.row + leaf / block_leaves * rows_of<Bound>
                          : StreamAccess::view(leaves).stream.data();
  }
  [[nodiscard]] std::size_t place_in_streams(std::size_t leaf) const noexcept {
    return blocks.exist() ? place_in_block(leaf, rows_of<Bound>) : leaf;
  }
  /// Words of entries of level `k`, which is at least 1, from entry `from` on.
  [[nodiscard]] BoxView node_words(std::size_t k, std::size_t from, std::size_t words) const noexcept {
    return nodes.view().slice(level[k].first + from, words * fanout);
  }

  /// Where leaves are written.
  [[nodiscard]] RowsOf<ViewOf<Bound>> leaf_rows() noexcept { return StreamAccess::rows(leaves); }
  /// Where entries of level `k` are written, from entry `from` on; k is at least 1.
  [[nodiscard]] RowsOf<BoxView> node_rows(std::size_t k, std::size_t from = 0) noexcept {
    return StreamAccess::rows(nodes, level[k].first + from);
  }
  [[nodiscard]] std::uint64_t* gap_words(std::size_t k) noexcept { return gaps.data() + level[k].first / 64; }
  [[nodiscard]] const std::uint64_t* gap_words(std::size_t k) const noexcept {
    return gaps.data() + level[k].first / 64;
  }
};

template <class Bound>
struct TreeParts : TreeLevels<Bound> {
  TreeArray<std::uint32_t> order;        ///< leaf → the user's index
  TreeArray<std::uint32_t> least_index;  ///< of each word of leaves
  LeafPlaces places;                     ///< the user's index → leaf

  /// The least index of the leaves of a word, or a lower one.
  [[nodiscard]] std::uint32_t least_index_below(std::size_t word) const noexcept {
    return this->blocks.exist() ? 0 : least_index[word];
  }
};

/// Lays out the levels over `size` bounds, and returns how many nodes there are.
template <class Bound>
std::size_t lay_out_levels(TreeLevels<Bound>& parts, std::size_t size) noexcept;

/// Lays out the levels over `size` bounds and gets the memory for them. Nodes are empty; leaves are to be written.
template <class Bound>
void lay_out(TreeLevels<Bound>& parts, std::size_t size);

// Kernels are passed along: a call goes on with the instruction set that it began with.

/// Fits all nodes, in parallel; leaves none dirty. If it throws, those that were dirty still are.
template <class Bound>
void fit_all(TreeLevels<Bound>& parts, const Kernels& kernels);

/// Fits an entry of level 1 to the word of leaves below it, of which `leaves` may be a copy.
///
/// Threads may fit entries at the same time if no two of these share a word of gaps: entries of different blocks of
/// gap_leaves leaves.
template <class Bound>
void fit_leaf_word(TreeLevels<Bound>& parts, const Kernels& kernels, std::size_t entry,
                   const ViewOf<Bound>& leaves) noexcept;
inline constexpr std::size_t gap_leaves = fanout * fanout;
static_assert(gap_leaves == block_leaves);

/// Fits one entry of a level above the first.
template <class Bound>
void fit_node_word(TreeLevels<Bound>& parts, const Kernels& kernels, std::size_t k, std::size_t entry) noexcept;

/// Fits the levels above level 1, whose entries are all fitted; leaves none dirty.
template <class Bound>
void fit_upper(TreeLevels<Bound>& parts, const Kernels& kernels) noexcept;

/// Fits the nodes above dirty words of leaves, and leaves none dirty. O(nodes fitted + size / 64²).
template <class Bound>
void fit_dirty(TreeLevels<Bound>& parts, const Kernels& kernels) noexcept;

/// The box around all bounds; the empty box if there are none.
template <class Bound>
Box box_around(const TreeLevels<Bound>& parts, const Kernels& kernels) noexcept;

/// Summed surface of boxes, halved; those that are empty or infinite are left out.
[[nodiscard]] double surface(const BoxView& boxes) noexcept;
/// That of the boxes of level 1.
template <class Bound>
double surface(const TreeLevels<Bound>& parts);

}  // namespace shaftcull::kernel
