// SPDX-License-Identifier: MIT
/// Blocks: what a dynamic tree is made of. The leaves below one word of nodes, with some leaves free, and these nodes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "kernels/kernel_table.hpp"
#include "query/leaf_blocks.hpp"
#include "streams/rows.hpp"
#include "support/large_memory.hpp"
#include "support/padding.hpp"
#include "support/shared.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

inline constexpr std::size_t block_words = block_leaves / fanout;

/// The empty bound, in the order of the streams.
template <class Bound>
[[nodiscard]] constexpr const float* padding_of() noexcept {
  if constexpr (std::is_same_v<Bound, Box>) {
    return padding_box;
  } else {
    return padding_sphere;
  }
}

/// How large a node is, in the measure by which a dynamic tree compares nodes: about the area of its surface, but not 0
/// for a line. May be infinite, or NaN.
[[nodiscard]] inline float node_measure(float x, float y, float z) noexcept { return (x + y + z) * (x + y + z); }

template <class Bound>
class LeafBlock : public Ownable {
 public:
  static constexpr std::size_t rows = rows_of<Bound>;

  /// All leaves are free.
  explicit LeafBlock(bool has_layers)
      : memory_(rows * block_leaves), order_(block_leaves), layers_(has_layers ? block_leaves : 0) {
    for (std::size_t w = 0; w != block_words; ++w) {
      for (std::size_t r = 0; r != rows; ++r) std::fill_n(at(w * fanout) + r * fanout, fanout, padding_of<Bound>()[r]);
    }
    std::fill_n(order_.get(), block_leaves, 0U);
    if (has_layers) std::fill_n(layers_.get(), block_leaves, 0U);
    for (std::size_t f = 0; f != 6; ++f) std::fill_n(node[f], block_words, padding_box[f]);
  }
  /// A copy, which may have layers where the other has none.
  LeafBlock(const LeafBlock& other, bool has_layers)
      : Ownable(),
        count(other.count),
        count_when_sorted(other.count_when_sorted),
        changed(other.changed),
        is_large(other.is_large),
        is_apart(other.is_apart),
        surface_when_sorted(other.surface_when_sorted),
        surface(other.surface),
        empties(other.empties),
        gaps(other.gaps),
        memory_(rows * block_leaves),
        order_(block_leaves),
        layers_(has_layers ? block_leaves : 0) {
    std::copy_n(other.memory_.get(), rows * block_leaves, memory_.get());
    std::copy_n(other.order(), block_leaves, order());
    std::copy_n(&other.node[0][0], 6 * block_words, &node[0][0]);
    std::copy_n(other.taken, block_words, taken);
    if (!has_layers) return;
    if (other.layers() != nullptr) {
      std::copy_n(other.layers(), block_leaves, layers());
      std::copy_n(other.word_layers, block_words, word_layers);
    } else {
      std::fill_n(layers(), block_leaves, ~std::uint32_t{0});
      std::fill_n(word_layers, block_words, ~std::uint32_t{0});
    }
  }
  LeafBlock(const LeafBlock&) = delete;
  LeafBlock& operator=(const LeafBlock&) = delete;
  ~LeafBlock() = default;

  /// Row r, from its first word on. place_in_block() finds a leaf in it.
  [[nodiscard]] const float* stream(std::size_t r) const noexcept { return memory_.get() + r * fanout; }
  [[nodiscard]] std::uint32_t* order() const noexcept { return order_.get(); }
  /// Null if all bounds are in all layers.
  [[nodiscard]] std::uint32_t* layers() const noexcept { return layers_.get(); }

  /// All rows of all leaves.
  [[nodiscard]] std::span<float> floats() const noexcept { return {memory_.get(), rows * block_leaves}; }

  [[nodiscard]] bool is_full(std::size_t word) const noexcept { return taken[word] == ~std::uint64_t{0}; }
  /// A free leaf of a word that is not full.
  [[nodiscard]] std::size_t free_leaf(std::size_t word) const noexcept {
    return word * fanout + static_cast<std::size_t>(std::countr_one(taken[word]));
  }
  /// To a leaf that is free.
  void write(std::size_t leaf, const float* bound, std::uint32_t index, std::uint32_t layers_of_bound) noexcept {
    empties += is_empty(bound) ? 1 : 0;
    put(leaf, bound);
    order()[leaf] = index;
    if (layers() != nullptr) layers()[leaf] = layers_of_bound;
    taken[leaf / fanout] |= std::uint64_t{1} << leaf % fanout;
  }
  /// To a leaf that is taken.
  void overwrite(std::size_t leaf, const float* bound, std::uint32_t layers_of_bound) noexcept {
    float before[rows];
    read(leaf, before);
    empties += is_empty(bound) ? 1 : 0;
    empties -= is_empty(before) ? 1 : 0;
    put(leaf, bound);
    if (layers() != nullptr) layers()[leaf] = layers_of_bound;
  }
  /// Frees a leaf that is taken.
  void clear(std::size_t leaf) noexcept {
    float bound[rows];
    read(leaf, bound);
    empties -= is_empty(bound) ? 1 : 0;
    put(leaf, padding_of<Bound>());
    if (layers() != nullptr) layers()[leaf] = 0;
    taken[leaf / fanout] &= ~(std::uint64_t{1} << leaf % fanout);
  }
  void read(std::size_t leaf, float (&bound)[rows]) const noexcept {
    const float* const from = at(leaf);
    for (std::size_t r = 0; r != rows; ++r) bound[r] = from[r * fanout];
  }
  [[nodiscard]] std::uint32_t layers_at(std::size_t leaf) const noexcept {
    return layers() == nullptr ? ~std::uint32_t{0} : layers()[leaf];
  }

  /// Fits the nodes of the words in `dirty` to their leaves, and finds the surface.
  void fit(std::uint64_t dirty, const Kernels& kernels) noexcept {
    NodeBounds* const node_bounds = kernels.node_bounds(ViewOf<Bound>{});
    for (std::uint64_t left = dirty; left != 0; left &= left - 1) {
      const auto word = static_cast<std::size_t>(std::countr_zero(left));
      const float* stream[rows];
      float* out[6];
      for (std::size_t r = 0; r != rows; ++r) stream[r] = at(word * fanout) + r * fanout;
      for (std::size_t f = 0; f != 6; ++f) out[f] = node[f] + word;
      const std::uint64_t gap = node_bounds(stream, 1, out);
      gaps = (gaps & ~(left & -left)) | (gap != 0 ? left & -left : 0);
    }
    if (empties == 0) gaps = 0;
    // Kernels fit no node to nothing.
    for (std::uint64_t left = dirty; left != 0; left &= left - 1) {
      const auto word = static_cast<std::size_t>(std::countr_zero(left));
      if (taken[word] != 0) continue;
      for (std::size_t f = 0; f != 6; ++f) node[f][word] = padding_box[f];
    }
    if (layers() != nullptr) fit_layers(dirty);
    surface = 0;
    for (std::size_t w = 0; w != block_words; ++w) {
      const float measure = node_measure(node[3][w] - node[0][w], node[4][w] - node[1][w], node[5][w] - node[2][w]);
      if (node[0][w] <= node[3][w] && measure < std::numeric_limits<float>::infinity()) surface += measure;
    }
  }
  /// Its bounds are sorted now.
  void begin_growth() noexcept {
    surface_when_sorted = surface;
    count_when_sorted = count;
    changed = 0;
  }
  /// How much its nodes have grown since its bounds were sorted.
  [[nodiscard]] double growth() const noexcept {
    return surface == surface_when_sorted ? 1 : surface / surface_when_sorted;
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return sizeof *this + sizeof(float) * rows * block_leaves + sizeof(std::uint32_t) * block_leaves +
           (layers() == nullptr ? 0 : sizeof(std::uint32_t) * block_leaves);
  }

  std::size_t count = 0;                     ///< bounds
  std::size_t count_when_sorted = 0;         ///< bounds when they were sorted
  std::size_t changed = 0;                   ///< bounds that came, went or moved since then
  bool is_large = false;                     ///< its bounds are larger than most (tree/size_class.hpp)
  bool is_apart = false;                     ///< it was sorted together with the blocks that it shared its space with
  double surface_when_sorted = 0;            ///< the sum of what nodes measured then
  double surface = 0;                        ///< the same now; infinite nodes are left out
  std::size_t empties = 0;                   ///< bounds that are empty
  std::uint64_t gaps = 0;                    ///< bit w is set if word w has such a bound; others may be, too
  std::uint64_t taken[block_words]{};        ///< which leaves have bounds
  std::uint32_t word_layers[block_words]{};  ///< all layers of a word's bounds, if there are layers
  float node[6][block_words];                ///< the boxes around words

 private:
  [[nodiscard]] static bool is_empty(const float* bound) noexcept { return rows == 6 && bound[3] < bound[0]; }

  /// Row 0 of a leaf; the others are `fanout` apart.
  [[nodiscard]] float* at(std::size_t leaf) const noexcept { return memory_.get() + place_in_block(leaf, rows); }
  void put(std::size_t leaf, const float* bound) noexcept {
    float* const to = at(leaf);
    for (std::size_t r = 0; r != rows; ++r) to[r * fanout] = bound[r];
  }

  void fit_layers(std::uint64_t dirty) noexcept {
    for (; dirty != 0; dirty &= dirty - 1) {
      const auto word = static_cast<std::size_t>(std::countr_zero(dirty));
      std::uint32_t all = 0;
      for (std::size_t i = 0; i != fanout; ++i) all |= layers()[word * fanout + i];
      word_layers[word] = all;
    }
  }

  LargeMemory<float> memory_;
  LargeMemory<std::uint32_t> order_;
  LargeMemory<std::uint32_t> layers_;
};

}  // namespace shaftcull::kernel
