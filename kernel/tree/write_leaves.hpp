// SPDX-License-Identifier: MIT
/// Leaves written a word at a time, and the nodes right above them while the word is at hand.
#pragma once

#include <algorithm>
#include <cstddef>

#include "simd/word_writer.hpp"
#include "support/compiler.hpp"
#include "support/index_range.hpp"
#include "tree/parts.hpp"
#include "tree/source.hpp"

namespace shaftcull::kernel {

/// Leaves ahead of those read whose bounds are prefetched, because tree order jumps about in the user's memory.
inline constexpr std::size_t prefetched_leaves = 64;

/// Writes leaves [range.first, range.end()), leaf range.first + i being bound order[i] of the source, and fits level 1
/// above them. range is whole words but for the tree's last one; if others write leaves at the same time, whole blocks
/// of gap_leaves. `order` goes on for `size` leaves, so far that bounds can be fetched ahead.
///
/// Written one leaf at a time, every leaf would write as many cache lines as there are streams, and keep the next one
/// waiting for them.
template <class Bound, class Source>
void write_leaves(TreeLevels<Bound>& parts, const Kernels& kernels, const std::uint32_t* order, std::size_t size,
                  const IndexRange& range, const Source& source) noexcept {
  constexpr std::size_t rows = rows_of<Bound>;
  const auto row = parts.leaf_rows();
  const WordWriter writer(parts.leaves.memory_bytes());
  alignas(64) float word[rows][fanout];
  const RowsOf<ViewOf<Bound>> to = rows_in(word);
  for (std::size_t first = range.first; first < range.end(); first += fanout) {
    const std::size_t count = std::min(fanout, range.end() - first);
    // Inlined, as prefetch_to_second_level() is.
    const std::size_t done = first - range.first;
    const auto prefetch_ahead = [=, &source, end = parts.is_worth_prefetching() ? size : 0](std::size_t i)
                                    SHAFTCULL_ALWAYS_INLINE_LAMBDA {
                                      const std::size_t soon = done + i + prefetched_leaves;
                                      if (soon + 4 > end) return;
                                      for (std::size_t p = soon; p != soon + 4; ++p) source.prefetch(order[p]);
                                    };
    read_rows(source, order + done, count, to.data(), prefetch_ahead);
    for (std::size_t s = 0; s != rows; ++s)
      std::copy(row[s] + first + count, row[s] + first + fanout, word[s] + count);  // padding
    for (std::size_t s = 0; s != rows; ++s) writer.write(row[s] + first, word[s], fanout);
    if (parts.levels > 1) fit_leaf_word(parts, kernels, first / fanout, view_of<ViewOf<Bound>>(to, fanout));
  }
}

}  // namespace shaftcull::kernel
