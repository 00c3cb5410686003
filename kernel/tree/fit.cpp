// SPDX-License-Identifier: MIT
/// Nodes around what they hold: one pass over the leaves, or over those that changed.
#include <algorithm>
#include <bit>
#include <cmath>

#include "parallel/parallel.hpp"
#include "support/index_range.hpp"
#include "support/padding.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {
namespace {

/// Fits `words` entries of level k, at most 64, from entry `first` on, a multiple of 64.
template <class Bound>
void fit_words(TreeLevels<Bound>& parts, const Kernels& kernels, std::size_t k, std::size_t first,
               std::size_t words) noexcept {
  const auto out = parts.node_rows(k, first);
  std::uint64_t gaps = 0;
  if (k == 1) {
    const ViewOf<Bound> in = parts.leaf_words(first * fanout, words);
    gaps = kernels.node_bounds(in)(in.stream.data(), words, out.data());
  } else {
    const BoxView in = parts.node_words(k - 1, first * fanout, words);
    gaps = kernels.node_bounds_of_boxes(in.stream.data(), words, out.data());
    const std::uint64_t* const below = parts.gap_words(k - 1) + first;
    for (std::size_t w = 0; w != words; ++w) gaps |= std::uint64_t{below[w] != 0} << w;
  }
  if (words < fanout) gaps |= ~std::uint64_t{0} << words;  // padding
  parts.gap_words(k)[first / fanout] = gaps;
}

template <class Bound>
void set_gap(TreeLevels<Bound>& parts, std::size_t k, std::size_t entry, bool is_gap) noexcept {
  const std::uint64_t bit = std::uint64_t{1} << entry % fanout;
  std::uint64_t& word = parts.gap_words(k)[entry / fanout];
  word = is_gap ? word | bit : word & ~bit;
}

/// Entries of level 1 that a task fits: 1.5 MiB of boxes.
constexpr std::size_t task_entries = 1024;
static_assert(task_entries % fanout == 0, "tasks must not share a word of gaps");

}  // namespace

template <class Bound>
void fit_leaf_word(TreeLevels<Bound>& parts, const Kernels& kernels, std::size_t entry,
                   const ViewOf<Bound>& leaves) noexcept {
  const std::uint64_t gap = kernels.node_bounds(leaves)(leaves.stream.data(), 1, parts.node_rows(1, entry).data());
  set_gap(parts, 1, entry, gap != 0);
}

template <class Bound>
void fit_node_word(TreeLevels<Bound>& parts, const Kernels& kernels, std::size_t k, std::size_t entry) noexcept {
  const BoxView in = parts.node_words(k - 1, entry * fanout, 1);
  const bool is_gap = kernels.node_bounds_of_boxes(in.stream.data(), 1, parts.node_rows(k, entry).data()) != 0;
  set_gap(parts, k, entry, is_gap || parts.gap_words(k - 1)[entry] != 0);
}

template <class Bound>
void fit_upper(TreeLevels<Bound>& parts, const Kernels& kernels) noexcept {
  for (std::size_t k = 2; k < parts.levels; ++k) {
    for (std::size_t first = 0; first < parts.level[k].entries; first += fanout) {
      fit_words(parts, kernels, k, first, std::min(fanout, parts.level[k].entries - first));
    }
  }
  std::fill(parts.dirty.begin(), parts.dirty.end(), 0);
  parts.dirty_words = 0;
}

template <class Bound>
void fit_all(TreeLevels<Bound>& parts, const Kernels& kernels) {
  if (parts.levels > 1) {
    const std::size_t entries = parts.level[1].entries;
    parallel_for(chunk_count(entries, task_entries), 1, [&](std::size_t t, std::size_t) {
      const IndexRange task = chunk_at(entries, task_entries, t);
      for (std::size_t first = task.first; first < task.end(); first += fanout) {
        fit_words(parts, kernels, 1, first, std::min(fanout, entries - first));
      }
    });
  }
  fit_upper(parts, kernels);
}

template <class Bound>
void fit_dirty(TreeLevels<Bound>& parts, const Kernels& kernels) noexcept {
  static_assert(fanout == 64, "a word of dirty bits is one entry of level 2");
  const std::size_t words = parts.dirty.size();
  if (parts.levels > 1) {
    for (std::size_t w = 0; w != words; ++w) {
      for (std::uint64_t left = parts.dirty[w]; left != 0; left &= left - 1) {
        const std::size_t entry = w * 64 + static_cast<std::size_t>(std::countr_zero(left));
        fit_leaf_word(parts, kernels, entry, parts.leaf_words(entry * fanout, 1));
      }
    }
  }
  for (std::size_t k = 2; k < parts.levels; ++k) {
    std::size_t next = 0;  // entries before this one are fitted, or not dirty
    for (std::size_t w = 0; w != words; ++w) {
      const std::size_t entry = w >> 6 * (k - 2);
      if (parts.dirty[w] == 0 || entry < next) continue;
      fit_node_word(parts, kernels, k, entry);
      next = entry + 1;
    }
  }
  std::fill(parts.dirty.begin(), parts.dirty.end(), 0);
  parts.dirty_words = 0;
}

template <class Bound>
Box box_around(const TreeLevels<Bound>& parts, const Kernels& kernels) noexcept {
  Box all = empty_box;
  if (parts.levels == 0) return all;
  // Boxes around the words of the highest level.
  float box[6][top_words];
  const RowsOf<BoxView> out = rows_in(box);
  const std::size_t top = parts.levels - 1;
  const std::size_t words = parts.level[top].words();
  if (top == 0) {
    const ViewOf<Bound> in = parts.leaf_words(0, words);
    kernels.node_bounds(in)(in.stream.data(), words, out.data());
  } else {
    const BoxView in = parts.node_words(top, 0, words);
    kernels.node_bounds_of_boxes(in.stream.data(), words, out.data());
  }
  for (std::size_t w = 0; w != words; ++w) {
    for (std::size_t k = 0; k != 3; ++k) {
      all.lo[k] = std::min(all.lo[k], box[k][w]);
      all.hi[k] = std::max(all.hi[k], box[k + 3][w]);
    }
  }
  return all;
}

double surface(const BoxView& boxes) noexcept {
  const auto& row = boxes.stream;
  double sum = 0;
  for (std::size_t i = 0; i != boxes.count; ++i) {
    const double x = static_cast<double>(row[3][i]) - static_cast<double>(row[0][i]);
    const double y = static_cast<double>(row[4][i]) - static_cast<double>(row[1][i]);
    const double z = static_cast<double>(row[5][i]) - static_cast<double>(row[2][i]);
    const double half = x * y + y * z + z * x;
    if (x >= 0 && std::isfinite(half)) sum += half;
  }
  return sum;
}

template <class Bound>
double surface(const TreeLevels<Bound>& parts) {
  if (parts.levels < 2) return 0;
  return surface(parts.node_words(1, 0, parts.level[1].words()).slice(0, parts.level[1].entries));
}

template void fit_leaf_word(TreeLevels<Box>& parts, const Kernels& kernels, std::size_t entry,
                            const BoxView& leaves) noexcept;
template void fit_leaf_word(TreeLevels<Sphere>& parts, const Kernels& kernels, std::size_t entry,
                            const SphereView& leaves) noexcept;
template void fit_node_word(TreeLevels<Box>& parts, const Kernels& kernels, std::size_t k, std::size_t entry) noexcept;
template void fit_node_word(TreeLevels<Sphere>& parts, const Kernels& kernels, std::size_t k,
                            std::size_t entry) noexcept;
template void fit_upper(TreeLevels<Box>& parts, const Kernels& kernels) noexcept;
template void fit_upper(TreeLevels<Sphere>& parts, const Kernels& kernels) noexcept;
template void fit_all(TreeLevels<Box>& parts, const Kernels& kernels);
template void fit_all(TreeLevels<Sphere>& parts, const Kernels& kernels);
template void fit_dirty(TreeLevels<Box>& parts, const Kernels& kernels) noexcept;
template void fit_dirty(TreeLevels<Sphere>& parts, const Kernels& kernels) noexcept;
template Box box_around(const TreeLevels<Box>& parts, const Kernels& kernels) noexcept;
template Box box_around(const TreeLevels<Sphere>& parts, const Kernels& kernels) noexcept;
template double surface(const TreeLevels<Box>& parts);
template double surface(const TreeLevels<Sphere>& parts);

}  // namespace shaftcull::kernel
