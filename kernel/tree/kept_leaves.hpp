// SPDX-License-Identifier: MIT
/// Leaves that shafts keep, until it is known where their indices are written.
#pragma once

#include <cstddef>
#include <cstdint>

#include "query/outputs.hpp"
#include "support/compiler.hpp"
#include "tree/leaf_indices.hpp"

namespace shaftcull::kernel {

/// Leaves that a shaft keeps, before it is known where their indices go: words of them, and ranges that are kept as a
/// whole. From four leaves a word on that takes less memory than indices, and these are not copied once more.
class KeptLeavesOutput {
 public:
  void add_word(std::size_t first, std::uint64_t bits) {
    if (bits == 0) return;
    items_.push({bits, static_cast<std::uint32_t>(first), 0});
    count_ += static_cast<std::size_t>(popcount_anywhere(bits));
  }
  void add_range(std::size_t first, std::size_t size) {
    items_.push({0, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(size)});
    count_ += size;
  }
  /// Number of leaves.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// Writes their indices from `out` on, count() of them and nothing else.
  void write(const LeafIndices& indices, std::uint32_t* out) const noexcept {
    const std::uint32_t* const end = out + count_;
    items_.for_each_chunk([&](const WordOrRange* item, std::size_t size) {
      for (std::size_t i = 0; i != size; ++i) {
        if (i + prefetched_words < size) indices.prefetch(item[i + prefetched_words].first);
        const auto [bits, first, range] = item[i];
        if (range != 0) {
          out = indices.copy(first, range, out);
        } else if (end - out >= static_cast<std::ptrdiff_t>(most_added)) {
          out += indices.compress(first, bits, out);
        } else {
          out += indices.compress_exactly(first, bits, out);  // what follows is somebody else's
        }
      }
    });
  }

 private:
  /// A word's bits, or a range of whole words.
  struct WordOrRange {
    std::uint64_t bits;
    std::uint32_t first;
    std::uint32_t range;  ///< size, or 0 for a word
  };
  /// Words ahead of the one written whose indices are prefetched.
  static constexpr std::size_t prefetched_words = 16;

  ChunkedOutput<WordOrRange> items_;
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
