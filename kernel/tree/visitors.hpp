// SPDX-License-Identifier: MIT
/// Results of the leaves that a walk finds: bits and lists of indices. Counts: query/counters.hpp.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "query/counters.hpp"
#include "query/outputs.hpp"
#include "support/compiler.hpp"
#include "tree/kept_leaves.hpp"
#include "tree/leaf_indices.hpp"
#include "tree/walk.hpp"

namespace shaftcull::kernel {

/// Leaves as the user's indices.
template <class Output>
class IndexList {
 public:
  static constexpr bool reads_indices = true;

  IndexList(const LeafIndices& indices, Output& output) noexcept : indices_(indices), output_(output) {}

  void bits(std::size_t first, std::uint64_t bits) {
    if (bits == 0) return;
    if (std::uint32_t* const out = output_.next()) {
      output_.advance(indices_.compress(first, bits, out));
    } else {
      for (; bits != 0; bits &= bits - 1) {
        output_.push(indices_[first + static_cast<std::size_t>(std::countr_zero(bits))]);
      }
    }
  }
  /// Whole words.
  void range(std::size_t first, std::size_t size) {
    for (std::size_t word = first; word != first + size; word += fanout) {
      if (std::uint32_t* const out = output_.next()) {
        indices_.copy(word, fanout, out);
        output_.advance(fanout);
      } else {
        bits(word, ~std::uint64_t{0});
      }
    }
  }

 private:
  LeafIndices indices_;
  Output& output_;
};

/// Leaves as they were found, to be written as the user's indices when it is known where to.
class KeptLeavesList {
 public:
  static constexpr bool reads_indices = false;

  explicit KeptLeavesList(KeptLeavesOutput& output) noexcept : output_(output) {}

  void bits(std::size_t first, std::uint64_t bits) { output_.add_word(first, bits); }
  void range(std::size_t first, std::size_t size) { output_.add_range(first, size); }

 private:
  KeptLeavesOutput& output_;
};

/// Leaves as bits by the user's index, which are all zero at first. If they are null, none are written.
class IndexBits {
 public:
  static constexpr bool reads_indices = true;

  IndexBits(const LeafIndices& indices, std::uint64_t* words) noexcept : indices_(indices), words_(words) {}

  void bits(std::size_t first, std::uint64_t bits) noexcept {
    if (words_ == nullptr) return;
    for (; bits != 0; bits &= bits - 1) set(first + static_cast<std::size_t>(std::countr_zero(bits)));
  }
  void range(std::size_t first, std::size_t size) noexcept {
    if (words_ == nullptr) return;
    for (std::size_t leaf = first; leaf != first + size; ++leaf) set(leaf);
  }

 private:
  void set(std::size_t leaf) noexcept {
    const std::uint32_t index = indices_[leaf];
    words_[index / 64] |= std::uint64_t{1} << index % 64;
  }

  LeafIndices indices_;
  std::uint64_t* words_;
};

/// Visitor that lists kept leaves, the first `limit` of them, and then ends the walk.
template <class List>
class LimitedLister {
 public:
  static constexpr bool reads_indices = List::reads_indices;

  LimitedLister(const List& kept, std::size_t limit) noexcept : kept_(kept), left_(limit) {}

  void word(std::size_t first, std::uint64_t kept, std::uint64_t /*inside*/) {
    auto set = static_cast<std::size_t>(popcount_anywhere(kept));
    if (set > left_) {
      std::uint64_t rest = kept;
      for (std::size_t i = 0; i != left_; ++i) rest &= rest - 1;
      kept &= ~rest;
      set = left_;
    }
    kept_.bits(first, kept);
    left_ -= set;
  }
  void range(std::size_t first, std::size_t size) {
    if (size <= left_) {
      kept_.range(first, size);
      left_ -= size;
    } else {
      for (; left_ != 0; first += fanout) word(first, ~std::uint64_t{0}, 0);
    }
  }
  [[nodiscard]] bool is_done() const noexcept { return left_ == 0; }

 private:
  List kept_;
  std::size_t left_;
};

/// Visitor that lists what is kept.
template <class List>
class KeptLister {
 public:
  static constexpr bool reads_indices = List::reads_indices;

  explicit KeptLister(const List& kept) noexcept : kept_(kept) {}

  void word(std::size_t first, std::uint64_t kept, std::uint64_t /*inside*/) { kept_.bits(first, kept); }
  void range(std::size_t first, std::size_t size) { kept_.range(first, size); }

 private:
  List kept_;
};

/// Visitor that lists what is kept and, once more, what of that is inside.
template <class List>
class KeptAndInsideLister {
 public:
  static constexpr bool reads_indices = List::reads_indices;

  KeptAndInsideLister(const List& kept, const List& inside) noexcept : kept_(kept), inside_(inside) {}

  void word(std::size_t first, std::uint64_t kept, std::uint64_t inside) {
    kept_.bits(first, kept);
    inside_.bits(first, inside);
  }
  void range(std::size_t first, std::size_t size) {
    kept_.range(first, size);
    inside_.range(first, size);
  }

 private:
  List kept_;
  List inside_;
};

/// Visitor that lists what overlaps and what is inside.
template <class List>
class ClassLister {
 public:
  static constexpr bool reads_indices = List::reads_indices;

  ClassLister(const List& overlap, const List& inside) noexcept : overlap_(overlap), inside_(inside) {}

  void word(std::size_t first, std::uint64_t kept, std::uint64_t inside) {
    overlap_.bits(first, kept & ~inside);
    inside_.bits(first, inside);
  }
  void range(std::size_t first, std::size_t size) { inside_.range(first, size); }

 private:
  List overlap_;
  List inside_;
};

/// Gives a visitor, as those above or a counter, what a walk finds. Besides word(), or words() for many at once, and
/// range() it may have
///
///     is_done()                        whether it has seen enough: the walk ends there
///     static reads_indices             whether it reads the user's indices of leaves
///     static looks_into_leaves         whether leaves are boxes around what it looks for
template <class Visitor>
class WordByWord final : public LeafVisitor {
  static constexpr bool looks_into_leaves = requires { Visitor::looks_into_leaves; };
  static constexpr bool reads_indices() noexcept {
    if constexpr (requires { Visitor::reads_indices; }) return Visitor::reads_indices;
    return false;
  }

 public:
  static constexpr VisitorTraits traits{EndsEarly<Visitor>, reads_indices(), looks_into_leaves};

  explicit WordByWord(Visitor& visitor) noexcept : visitor_(visitor) {}

  bool words(const FoundWords& found) override {
    if constexpr (requires { visitor_.words(found); }) {
      visitor_.words(found);
    } else {
      const auto [word, kept, inside, words] = found;
      for (std::size_t i = 0; i != words; ++i) {
        if (kept[i] == 0) continue;
        visitor_.word(std::size_t{word[i]} * fanout, kept[i], inside != nullptr ? inside[i] : 0);
        if (is_done(visitor_)) return false;
      }
    }
    return !is_done(visitor_);
  }
  bool word(std::size_t first, std::uint64_t kept, std::uint64_t inside) override {
    if constexpr (requires { visitor_.word(first, kept, inside); }) {
      visitor_.word(first, kept, inside);
    } else {
      visitor_.words({nullptr, &kept, &inside, 1});
    }
    return !is_done(visitor_);
  }
  bool range(std::size_t first, std::size_t size) override {
    visitor_.range(first, size);
    return !is_done(visitor_);
  }

 private:
  Visitor& visitor_;
};

}  // namespace shaftcull::kernel
