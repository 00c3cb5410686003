// SPDX-License-Identifier: MIT
/// Bounds of streams that a query leaves out for one shaft.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "flat/candidates.hpp"
#include "kernels/table.hpp"
#include "query/options.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Clears their bits. Bit i of a row is bound i, or the i-th candidate.
class LeftOut {
 public:
  /// `layers` are those of bounds by position; `candidates` are null for all bounds.
  LeftOut(const Options& options, std::size_t s, const std::uint32_t* layers,
          const std::optional<std::span<const std::uint32_t>>& candidates, const Positions& position,
          KeepLayers* keep) noexcept
      : excluded_(options.excluded(s)),
        layer_mask_(options.layers(s)),
        layers_(layers),
        candidates_(candidates),
        position_(position),
        keep_(keep),
        is_on_(options.leave_out()) {}

  /// Clears bits of `count` bounds from bound `first` on, a multiple of 64. `words` may be null.
  void clear(std::size_t first, std::size_t count, std::uint64_t* words) const noexcept {
    if (!is_on_ || words == nullptr) [[likely]]
      return;
    clear_row(first, count, words);
  }

 private:
  SHAFTCULL_NOINLINE void clear_row(std::size_t first, std::size_t count, std::uint64_t* words) const noexcept {
    if (candidates_) return clear_candidates(first, count, words);
    if (!excluded_.mask.empty()) {
      for (std::size_t w = 0; w != words_for(count); ++w) words[w] &= ~excluded_.mask[first / 64 + w];
    }
    clear_indices(excluded_.of_all, first, count, words);
    clear_indices(excluded_.of_shaft, first, count, words);
    if (!layer_mask_) return;
    const std::size_t whole = count / 64;
    for (std::size_t w = 0; w != whole; ++w) {
      if (words[w] != 0) words[w] &= keep_(layers_ + first + 64 * w, *layer_mask_);
    }
    if (count % 64 == 0) return;
    std::uint32_t last[64] = {};
    std::copy_n(layers_ + first + 64 * whole, count % 64, last);
    words[whole] &= keep_(last, *layer_mask_);
  }

  static void clear_indices(std::span<const std::uint32_t> indices, std::size_t first, std::size_t count,
                            std::uint64_t* words) noexcept {
    for (const std::uint32_t index : indices) {
      const std::size_t i = index - first;  // larger than all counts if the index is below `first`
      if (i < count) words[i / 64] &= ~(std::uint64_t{1} << i % 64);
    }
  }

  void clear_candidates(std::size_t first, std::size_t count, std::uint64_t* words) const noexcept {
    for (std::size_t w = 0; w != words_for(count); ++w) {
      for (std::uint64_t left = words[w]; left != 0; left &= left - 1) {
        const std::uint32_t index = (*candidates_)[first + 64 * w + static_cast<std::size_t>(std::countr_zero(left))];
        const bool is_out = excluded_.has(index) || (layer_mask_ && (layers_[position_[index]] & *layer_mask_) == 0);
        if (is_out) words[w] &= ~(left & -left);
      }
    }
  }

  ExcludedIndices excluded_;
  std::optional<std::uint32_t> layer_mask_;
  const std::uint32_t* layers_;
  std::optional<std::span<const std::uint32_t>> candidates_;
  Positions position_;
  KeepLayers* keep_;
  bool is_on_;
};

}  // namespace shaftcull::kernel
