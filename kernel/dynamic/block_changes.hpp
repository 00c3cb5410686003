// SPDX-License-Identifier: MIT
/// Changes of one block: bounds go, move, and come.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "dynamic/changes.hpp"
#include "dynamic/nearest.hpp"
#include "support/compiler.hpp"
#include "tree/leaf_block.hpp"
#include "tree/size_class.hpp"

namespace shaftcull::kernel {

/// Where the places of indices are written: by several threads, each for the bounds of its blocks.
class PlaceWriter {
 public:
  /// Of the block of this number.
  PlaceWriter(std::uint32_t* const* page, std::uint32_t number) noexcept
      : page_(page), first_(number << LeafBlocks::number_shift) {}

  void set(std::uint32_t index, std::size_t leaf) const noexcept {
    at(index) = first_ + static_cast<std::uint32_t>(leaf);
  }
  void clear(std::uint32_t index) const noexcept { at(index) = 0; }

 private:
  [[nodiscard]] std::uint32_t& at(std::uint32_t index) const noexcept {
    return page_[index / LeafBlocks::page_size][index % LeafBlocks::page_size];
  }

  std::uint32_t* const* page_;
  std::uint32_t first_;
};

/// Makes changes in a block, which has free leaves for all that come. Nothing is allocated.
template <class Bound>
class BlockChanges {
 public:
  BlockChanges(LeafBlock<Bound>& block, const PlaceWriter& places, const Kernels& kernels) noexcept
      : block_(block), places_(places), kernels_(kernels) {
    for (std::size_t f = 0; f != 6; ++f) node_[f] = block.node[f];
  }

  /// A bound that is erased, or goes to another block.
  void erase(std::size_t leaf, const Change<Bound>& change) noexcept {
    if (change.has_bound == 0) places_.clear(change.index);
    ++block_.changed;
    block_.clear(leaf);
    --block_.count;
    note(leaf / fanout);
    mark(leaf / fanout);
  }

  /// Gives a leaf's bound another value, which the block's box holds, or about.
  void move(std::size_t leaf, const Change<Bound>& change) noexcept {
    float corner[6];
    corners_of(change.bound, corner);
    ++block_.changed;
    const std::size_t word = leaf / fanout;
    if (!box_holds(node_, word, corner) && has_grown_much_with(word, corner)) {
      look_at_words();
      has_space_[word] = 0;  // it has the leaf that the bound has now
      const std::size_t best = best_node_for(node_, corner, has_space_, kernels_).node;
      note(word);
      if (best != word) {
        block_.clear(leaf);
        note(word);
        mark(word);
        return put(best, corner, change);
      }
    }
    grow_box(node_, word, corner);
    block_.overwrite(leaf, change.bound, change.layers);
    mark(word);
  }

  void insert(const Change<Bound>& change) noexcept {
    float corner[6];
    corners_of(change.bound, corner);
    ++block_.count;
    ++block_.changed;
    look_at_words();
    if (used_ == 0) return put(0, corner, change);
    // The best word may be full. Then some of its bounds go elsewhere first.
    std::size_t word = best_node_for(node_, corner, is_used_, kernels_).node;
    if (block_.is_full(word)) {
      make_space(word);
      word = best_node_for(node_, corner, has_space_, kernels_).node;
    }
    put(word, corner, change);
  }

  /// Fits the nodes of all words that were touched. Returns the words whose nodes were fitted, as bits.
  std::uint64_t finish() noexcept {
    block_.fit(dirty_, kernels_);
    return dirty_;
  }

 private:
  static constexpr std::uint64_t bit(std::size_t word) noexcept { return std::uint64_t{1} << word; }
  void mark(std::size_t word) noexcept { dirty_ |= bit(word); }
  /// Notes which words are used, and which have a free leaf: from the first bound on that looks for a word.
  void look_at_words() noexcept {
    if (knows_words_) return;
    knows_words_ = true;
    for (std::size_t w = 0; w != block_words; ++w) note(w);
  }
  void note(std::size_t word) noexcept {
    if (!knows_words_) return;
    const std::uint64_t taken = block_.taken[word];
    used_ = taken != 0 ? used_ | bit(word) : used_ & ~bit(word);
    is_used_[word] = taken != 0 ? 0 : ruled_out;
    has_space_[word] = taken != 0 && ~taken != 0 ? 0 : ruled_out;
  }

  void put(std::size_t word, const float (&corner)[6], const Change<Bound>& change) noexcept {
    const std::size_t leaf = block_.free_leaf(word);
    block_.write(leaf, change.bound, change.index, change.layers);
    grow_box(node_, word, corner);
    note(word);
    mark(word);
    places_.set(change.index, leaf);
  }

  /// Whether a word is much larger with a box: only then another word is looked for.
  [[nodiscard]] bool has_grown_much_with(std::size_t word, const float (&corner)[6]) const noexcept {
    return !(measure_with(node_, word, corner) <= 1.125F * measure_of(node_, word));
  }

  /// Shares the bounds of a full word with another one: an unused one, or else the one that is nearest of those with
  /// some space.
  void make_space(std::size_t word) noexcept {
    if (~used_ != 0) return share(word, static_cast<std::size_t>(std::countr_one(used_)));
    std::size_t other = block_words;
    float least_measure = std::numeric_limits<float>::infinity();
    for (std::size_t w = 0; w != block_words; ++w) {
      if (popcount_anywhere(block_.taken[w]) > most_in_partner) continue;
      const float measure = measure_with(node_, w, corners_at(node_, word).corner);
      if (!(measure < least_measure)) continue;
      least_measure = measure;
      other = w;
    }
    if (other != block_words) share(word, other);
  }
  static constexpr int most_in_partner = 56;

  /// Sorts the bounds of two words: those that are low on the axis on which centres are spread most go to the first.
  void share(std::size_t word, std::size_t other) noexcept {
    struct Member {
      float centre;
      std::uint32_t number;
      bool operator<(const Member& than) const noexcept {
        return centre < than.centre || (centre == than.centre && number < than.number);
      }
    };
    struct Copy {
      float bound[rows_of<Bound>];
      std::uint32_t index;
      std::uint32_t layers;
    };
    Copy copy[2 * fanout];
    Vec3 centre[2 * fanout];
    Vec3 low{};
    Vec3 high{};
    std::uint32_t count = 0;
    for (const std::size_t from : {word, other}) {
      for (std::uint64_t left = block_.taken[from]; left != 0; left &= left - 1) {
        const std::size_t leaf = from * fanout + static_cast<std::size_t>(std::countr_zero(left));
        block_.read(leaf, copy[count].bound);
        copy[count].index = block_.order()[leaf];
        copy[count].layers = block_.layers_at(leaf);
        centre[count] = placement(copy[count].bound).centre;
        for (std::size_t k = 0; k != 3; ++k) {
          low[k] = count == 0 ? centre[0][k] : lesser(low[k], centre[count][k]);
          high[k] = count == 0 ? centre[0][k] : greater(high[k], centre[count][k]);
        }
        ++count;
      }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k != 3; ++k) {
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    }
    Member member[2 * fanout];
    for (std::uint32_t i = 0; i != count; ++i) member[i] = {centre[i][axis], i};
    std::nth_element(member, member + count / 2, member + count);
    // So that leaves do not depend on the standard library.
    bool is_high[2 * fanout] = {};
    for (std::uint32_t i = count / 2; i != count; ++i) is_high[member[i].number] = true;
    for (const std::size_t to : {word, other}) {
      for (std::size_t f = 0; f != 6; ++f) node_[f][to] = padding_box[f];
      for (std::uint64_t left = block_.taken[to]; left != 0; left &= left - 1) {
        block_.clear(to * fanout + static_cast<std::size_t>(std::countr_zero(left)));
      }
      mark(to);
    }
    for (std::uint32_t i = 0; i != count; ++i) {
      const std::size_t to = is_high[i] ? other : word;
      const std::size_t leaf = block_.free_leaf(to);
      block_.write(leaf, copy[i].bound, copy[i].index, copy[i].layers);
      places_.set(copy[i].index, leaf);
      float corner[6];
      corners_of(copy[i].bound, corner);
      grow_box(node_, to, corner);
    }
    note(word);
    note(other);
  }

  LeafBlock<Bound>& block_;
  PlaceWriter places_;
  const Kernels& kernels_;
  float* node_[6];
  bool knows_words_ = false;
  float is_used_[block_words];    ///< 0 for words that are used, as best_node_for() has it
  float has_space_[block_words];  ///< 0 for those that have a free leaf, too
  std::uint64_t used_ = 0;
  std::uint64_t dirty_ = 0;
};

}  // namespace shaftcull::kernel
