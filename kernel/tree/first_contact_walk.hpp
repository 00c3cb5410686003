// SPDX-License-Identifier: MIT
/// The walk that looks for what a shaft reaches first: near nodes first, and none that is reached too late.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "compiled/contact.hpp"
#include "compiled/joining_planes.hpp"
#include "compiled/with_planes.hpp"
#include "exact/first_entry.hpp"
#include "exact/start_overlap.hpp"
#include "kernels/kernel_table.hpp"
#include "support/compiler.hpp"
#include "support/prefetch.hpp"
#include "tree/exclusion.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

template <class Bound>
class FirstContactWalk {
 public:
  FirstContactWalk(const TreeParts<Bound>& parts, const Kernels& kernels, const ShaftData& shaft,
                   const Exclusion& exclusion, bool skips_overlapping = false) noexcept
      : parts_(parts),
        test_leaves_(kernels.listed(ViewOf<Bound>{})),
        test_nodes_(kernels.listed_boxes),
        with_planes_(shaft, outside_needs_planes(shaft, std::is_same_v<Bound, Sphere>)),
        of_nodes_(with_planes_.shaft()),
        exclusion_(exclusion),
        prefetches_(parts.is_worth_prefetching()),
        indices_(exclusion.indices()),
        start_(shaft),
        first_(shaft) {
    if (skips_overlapping) begin_skipping(shaft, kernels);
  }

  /// What is reached first of the leaves that are not left out.
  const FirstEntry<ViewOf<Bound>>& run() noexcept {
    if (parts_.levels == 0) return first_;
    const std::size_t top = parts_.levels - 1;
    for (std::uint32_t w = 0; w != parts_.level[top].words(); ++w) visit(top, w);
    return first_;
  }

 private:
  /// An entry of a word of nodes that the shaft meets.
  struct Node {
    double time;                ///< about when it is reached: nothing below is reached earlier, but for rounding
    std::uint64_t least_index;  ///< of the leaves below, or a lower one
    std::uint32_t entry;

    friend bool operator<(const Node& a, const Node& b) noexcept {
      return a.time < b.time || (a.time == b.time && a.least_index < b.least_index);
    }
  };

  /// Nodes whose words are prefetched before they are visited.
  static constexpr std::size_t prefetched_nodes = 4;

  void visit(std::size_t k, std::uint32_t word) noexcept {
    if (k == 0) return visit_leaves(word);
    const auto stream = parts_.node_words(k, 0, parts_.level[k].words()).stream;
    std::uint64_t kept = 0;
    test_nodes_(of_nodes_.shaft(), stream.data(), &word, 1, &kept, nullptr, 1);
    const std::uint32_t from = word * static_cast<std::uint32_t>(fanout);
    kept = exclusion_.nodes(k, from, kept);
    if (!first_.is_there() && !skips_overlapping_) kept &= ~visit_at_start(k, from, kept, stream.data());
    Node node[fanout];
    std::size_t nodes = 0;
    const bool is_at_start = first_.is_at_start();
    for (; kept != 0; kept &= kept - 1) {
      const std::uint32_t entry = from + static_cast<std::uint32_t>(std::countr_zero(kept));
      const std::uint64_t least = k == 1 ? parts_.least_index_below(entry) : 0;
      if (first_.is_before_all_above(least)) continue;  // which takes no time to work out
      if (skips_overlapping_ && start_.has_all_within(stream.data(), entry)) continue;
      if (is_at_start) {
        if (start_.touches(stream.data(), entry)) node[nodes++] = {0, least, entry};
        continue;
      }
      const double time = first_.times_of_boxes().rough(stream.data(), entry);
      if (!first_.is_no_first(time, least)) node[nodes++] = {time, least, entry};
    }
    std::sort(node, node + nodes);
    for (std::size_t n = 0; n != std::min(nodes, prefetched_nodes); ++n) prefetch(k - 1, node[n].entry);
    for (std::size_t n = 0; n != nodes; ++n) {
      if (n + prefetched_nodes < nodes) prefetch(k - 1, node[n + prefetched_nodes].entry);
      if (!first_.is_no_first(node[n].time, node[n].least_index)) visit(k - 1, node[n].entry);
    }
  }

  /// Of a word of entries of level k, visits one of those in `kept` that the box touches where it starts, if there is
  /// one, and returns its bit. Where thousands are reached at once, what is found there spares most of the others: only
  /// a lower index comes before it, which takes no times.
  std::uint64_t visit_at_start(std::size_t k, std::uint32_t from, std::uint64_t kept,
                               const float* const* stream) noexcept {
    std::uint64_t best = 0;
    std::uint64_t least = 0;
    for (std::uint64_t left = kept; left != 0; left &= left - 1) {
      const std::uint32_t entry = from + static_cast<std::uint32_t>(std::countr_zero(left));
      if (!start_.touches(stream, entry)) continue;
      const std::uint64_t index = k == 1 ? parts_.least_index_below(entry) : 0;
      if (best != 0 && index >= least) continue;
      best = left & -left;
      least = index;
    }
    if (best != 0) visit(k - 1, from + static_cast<std::uint32_t>(std::countr_zero(best)));
    return best;
  }

  void visit_leaves(std::uint32_t word) noexcept {
    std::uint64_t kept = 0;
    const std::size_t from = std::size_t{word} * fanout;
    const float* const* const stream = parts_.streams_at(from);
    const std::size_t place = parts_.place_in_streams(from);
    const auto word_in_stream = static_cast<std::uint32_t>(place / fanout);
    test_leaves_(with_planes_.shaft(), stream, &word_in_stream, 1, &kept, nullptr, 1);
    if (kept != 0 && skips_overlapping_) {
      std::uint64_t at_start = 0;
      test_leaves_(*at_start_, stream, &word_in_stream, 1, &at_start, nullptr, 1);
      kept &= ~at_start;
    }
    if (kept != 0) kept = exclusion_.leaves(from, kept);
    for (; kept != 0; kept &= kept - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(kept));
      first_.offer(stream, place + i, indices_[from + i]);
    }
  }

  /// Forms what keeps all that the box overlaps where it starts: a shaft from there to there.
  void begin_skipping(const ShaftData& shaft, const Kernels& kernels) noexcept {
    skips_overlapping_ = true;
    ShaftData& at_start = at_start_.emplace();
    const Box box{{shaft.a[0], shaft.a[1], shaft.a[2]}, {shaft.a[3], shaft.a[4], shaft.a[5]}};
    kernels.compile_pair(box, box, at_start);
    apply_contact(at_start, shaft.contact);
    if (outside_needs_planes(at_start, std::is_same_v<Bound, Sphere>)) add_joining_planes(at_start);
  }

  /// Prefetches a word of entries of level k.
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t k, std::size_t word) const noexcept {
    if (!prefetches_) return;
    const std::size_t first = word * fanout;
    if (k == 0) {
      const float* const* const stream = parts_.streams_at(first);
      const std::size_t at = parts_.place_in_streams(first);
      for (std::size_t r = 0; r != rows_of<Bound>; ++r) prefetch_to_second_level(stream[r] + at, fanout);
      exclusion_.prefetch(first);
    } else {
      for (const float* const row : parts_.node_words(k, first, 1).stream) prefetch_to_second_level(row, fanout);
    }
  }

  const TreeParts<Bound>& parts_;
  TestListedWords* test_leaves_;
  TestListedWords* test_nodes_;
  WithPlanes with_planes_;
  WithClosedContact of_nodes_;
  Exclusion exclusion_;
  bool prefetches_;
  LeafIndices indices_;
  StartOverlap start_;
  bool skips_overlapping_ = false;
  std::optional<ShaftData> at_start_;  ///< if what overlaps the start is skipped
  FirstEntry<ViewOf<Bound>> first_;
};

}  // namespace shaftcull::kernel
