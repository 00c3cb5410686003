// SPDX-License-Identifier: MIT
/// Results of queries: counts, bits and lists, and the rule for results that do not fit.
///
/// A call that lists into a span returns the number of results, whether they fit or not. It writes the first results,
/// as many as fit, and only counts the others. If the number is larger than the span, call again with a span of that
/// size. An empty span is legal: the call then counts. Elements after the last result may be overwritten.
///
/// A call that lists into a vector or into IndexLists makes room itself. A call that writes bits, or one number per
/// shaft, takes a span of exactly the right size, and throws InvalidArgument for any other.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The answer of a shaft for one bound.
enum class Answer : std::uint8_t {
  outside,  ///< no point of the bound is in the shaft
  overlap,  ///< some points of the bound are in the shaft, or the bound touches it
  inside,   ///< all points of the bound are in the shaft
};

/// The number of bounds with each answer. A shaft keeps overlap + inside.
struct KeptCounts {
  std::size_t overlap;  ///< bounds neither outside nor inside
  std::size_t inside;   ///< bounds entirely inside the shaft
  friend bool operator==(const KeptCounts&, const KeptCounts&) = default;
};

/// A view of bits, as cull() and related calls write them: bit i % 64 of word i / 64 is the bit of bound i. The caller
/// owns the words. Iteration gives the indices of the set bits, ascending:
///
///     for (const std::size_t i : BitView(kept)) …
class BitView {
 public:
  /// Iterates over the set bits.
  class Iterator {
   public:
    using value_type = std::size_t;                     ///< an index
    using difference_type = std::ptrdiff_t;             ///< unused
    using iterator_category = std::input_iterator_tag;  ///< each value is made when it is read

    constexpr Iterator() noexcept = default;
    /// The index of the bit.
    constexpr std::size_t operator*() const noexcept {
      return word_ * 64 + static_cast<std::size_t>(std::countr_zero(left_));
    }
    constexpr Iterator& operator++() noexcept {
      left_ &= left_ - 1;
      skip_zeros();
      return *this;
    }
    constexpr Iterator operator++(int) noexcept {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    friend constexpr bool operator==(const Iterator& a, const Iterator& b) noexcept {
      return a.word_ == b.word_ && a.left_ == b.left_;
    }

   private:
    friend class BitView;
    constexpr Iterator(std::span<const std::uint64_t> words, std::size_t word) noexcept : words_(words), word_(word) {
      if (word_ != words_.size()) left_ = words_[word_];
      skip_zeros();
    }
    constexpr void skip_zeros() noexcept {
      while (left_ == 0 && word_ != words_.size()) {
        if (++word_ != words_.size()) left_ = words_[word_];
      }
    }

    std::span<const std::uint64_t> words_{};
    std::size_t word_ = 0;
    std::uint64_t left_ = 0;
  };

  constexpr BitView() noexcept = default;
  /// A view of these words. Bits past the last bound must be zero, as all calls leave them.
  constexpr explicit BitView(std::span<const std::uint64_t> words) noexcept : words_(words) {}

  /// Bit i, which is below 64 times the number of words; not checked.
  [[nodiscard]] constexpr bool operator[](std::size_t i) const noexcept { return (words_[i / 64] >> i % 64 & 1) != 0; }
  /// The number of set bits. O(words).
  [[nodiscard]] constexpr std::size_t count() const noexcept {
    std::size_t set = 0;
    for (const std::uint64_t word : words_) set += static_cast<std::size_t>(std::popcount(word));
    return set;
  }
  /// The first set bit, and the end of the set bits.
  [[nodiscard]] constexpr Iterator begin() const noexcept { return {words_, 0}; }
  [[nodiscard]] constexpr Iterator end() const noexcept { return {words_, words_.size()}; }

 private:
  std::span<const std::uint64_t> words_{};
};

/// Index lists in compressed sparse rows: the list of shaft s is indices[offsets[s] … offsets[s + 1]).
struct IndexLists {
  std::vector<std::uint64_t> offsets;  ///< number of shafts + 1; the first is 0
  std::vector<std::uint32_t> indices;  ///< all lists, one after another

  /// Iterates over the lists.
  class Iterator {
   public:
    using value_type = std::span<const std::uint32_t>;  ///< a list
    using difference_type = std::ptrdiff_t;             ///< unused
    using iterator_category = std::input_iterator_tag;  ///< each value is made when it is read

    Iterator() noexcept = default;
    /// The list of a shaft.
    std::span<const std::uint32_t> operator*() const noexcept { return (*lists_)[shaft_]; }
    Iterator& operator++() noexcept {
      ++shaft_;
      return *this;
    }
    Iterator operator++(int) noexcept {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) noexcept { return a.shaft_ == b.shaft_; }

   private:
    friend struct IndexLists;
    Iterator(const IndexLists& lists, std::size_t shaft) noexcept : lists_(&lists), shaft_(shaft) {}

    const IndexLists* lists_ = nullptr;
    std::size_t shaft_ = 0;
  };

  /// The number of lists: one per shaft.
  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  /// The list of `shaft`, which is below size(); not checked.
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t shaft) const noexcept {
    return {indices.data() + offsets[shaft], static_cast<std::size_t>(offsets[shaft + 1] - offsets[shaft])};
  }
  /// The list of the first shaft, and the end of the lists.
  [[nodiscard]] Iterator begin() const noexcept { return {*this, 0}; }
  [[nodiscard]] Iterator end() const noexcept { return {*this, size()}; }
};

}  // namespace shaftcull
