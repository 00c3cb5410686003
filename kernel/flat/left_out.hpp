// SPDX-License-Identifier: MIT
/// Bounds of streams that a query leaves out for one shaft.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "flat/scanned_bounds.hpp"
#include "kernels/kernel_table.hpp"
#include "query/options.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Clears their bits. Bit i of a row is bound i, or the i-th candidate. Refers to the options and the bounds.
class LeftOut {
 public:
  LeftOut(const Options& options, std::size_t s, const ScannedBounds& bounds, const Kernels& kernels) noexcept
      : options_(options), bounds_(bounds), kernels_(kernels), shaft_(s) {}

  /// Clears bits of `count` bounds from bound `first` on, a multiple of 64. `words` may be null.
  void clear(std::size_t first, std::size_t count, std::uint64_t* words) const noexcept {
    if (!options_.leave_out() || words == nullptr) [[likely]]
      return;
    clear_row(first, count, words);
  }

 private:
  SHAFTCULL_NOINLINE void clear_row(std::size_t first, std::size_t count, std::uint64_t* words) const noexcept {
    const ExcludedIndices excluded = options_.excluded(shaft_);
    const std::optional<std::uint32_t> layer_mask = options_.layers(shaft_);
    if (bounds_.candidates) return clear_candidates(excluded, layer_mask, first, count, words);
    if (!excluded.mask.empty()) {
      for (std::size_t w = 0; w != bit_words(count); ++w) words[w] &= ~excluded.mask[first / 64 + w];
    }
    clear_indices(excluded.of_all, first, count, words);
    clear_indices(excluded.of_shaft, first, count, words);
    if (!layer_mask) return;
    const std::size_t whole = count / 64;
    for (std::size_t w = 0; w != whole; ++w) {
      if (words[w] != 0) words[w] &= kernels_.keep_layers(bounds_.layers + first + 64 * w, *layer_mask);
    }
    if (count % 64 == 0) return;
    std::uint32_t last[64] = {};
    std::copy_n(bounds_.layers + first + 64 * whole, count % 64, last);
    words[whole] &= kernels_.keep_layers(last, *layer_mask);
  }

  static void clear_indices(std::span<const std::uint32_t> indices, std::size_t first, std::size_t count,
                            std::uint64_t* words) noexcept {
    for (const std::uint32_t index : indices) {
      const std::size_t i = index - first;  // larger than all counts if the index is below `first`
      if (i < count) words[i / 64] &= ~(std::uint64_t{1} << i % 64);
    }
  }

  void clear_candidates(const ExcludedIndices& excluded, const std::optional<std::uint32_t>& layer_mask,
                        std::size_t first, std::size_t count, std::uint64_t* words) const noexcept {
    for (std::size_t w = 0; w != bit_words(count); ++w) {
      for (std::uint64_t left = words[w]; left != 0; left &= left - 1) {
        const std::uint32_t index =
            (*bounds_.candidates)[first + 64 * w + static_cast<std::size_t>(std::countr_zero(left))];
        const bool is_out =
            excluded.has(index) || (layer_mask && (bounds_.layers_at(bounds_.position[index]) & *layer_mask) == 0);
        if (is_out) words[w] &= ~(left & -left);
      }
    }
  }

  const Options& options_;
  const ScannedBounds& bounds_;
  const Kernels& kernels_;
  std::size_t shaft_;
};

}  // namespace shaftcull::kernel
