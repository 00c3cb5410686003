// SPDX-License-Identifier: MIT
/// One shaft against many bounds: bits, counts and lists.
#include <cstdint>
#include <span>

#include "ask.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::CompiledShaft;
using shaftcull::KeptCounts;
using shaftcull::LeafRangeOf;

namespace {

template <class Index>
shaftcull_status list(const shaftcull_shafts* shafts, std::uint64_t shaft, const shaftcull_bounds* bounds,
                      const shaftcull_query* query, Index* kept, std::uint64_t room,
                      std::uint64_t* kept_count) noexcept {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<Index> out = as_span(kept, room, "kept");
    std::uint64_t& count = given(kept_count, "kept_count");
    ask_bounds(bounds, query, takes_width<Index>, [&](const ListedBy<Index> auto& set, const auto& option) {
      count = shaftcull::list(asked, set, out, option);
    });
  });
}

template <class Index>
shaftcull_status list_at_most(const shaftcull_shafts* shafts, std::uint64_t shaft, const shaftcull_bounds* bounds,
                              const shaftcull_query* query, Index* kept, std::uint64_t room,
                              std::uint64_t* kept_count) noexcept {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<Index> out = as_span(kept, room, "kept");
    std::uint64_t& count = given(kept_count, "kept_count");
    ask_bounds(
        bounds, query, takes_width<Index>,
        [&]<class Set>(const Set& set, const auto& option) requires(BoundSet<Set> && ListedBy<Set, Index>) {
          count = shaftcull::list_at_most(asked, set, out, option);
        });
  });
}

template <class Index>
shaftcull_status list_classified(const shaftcull_shafts* shafts, std::uint64_t shaft, const shaftcull_bounds* bounds,
                                 const shaftcull_query* query, Index* overlap, std::uint64_t overlap_room,
                                 Index* inside, std::uint64_t inside_room, shaftcull_kept_counts* counts) noexcept {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<Index> overlapping = as_span(overlap, overlap_room, "overlap");
    const std::span<Index> within = as_span(inside, inside_room, "inside");
    shaftcull_kept_counts& out = given(counts, "counts");
    ask_bounds(
        bounds, query, takes_width<Index>,
        [&]<class Set>(const Set& set, const auto& option) requires(BoundSet<Set> && ListedBy<Set, Index>) {
          out = from_counts(shaftcull::list_classified(asked, set, overlapping, within, option));
        });
  });
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_cull(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                const shaftcull_query* query, uint64_t* kept, uint64_t words) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint64_t> out = as_span(kept, words, "kept");
    ask_bounds(bounds, query, takes_any,
               [&](const AnySet auto& set, const auto& option) { shaftcull::cull(asked, set, out, option); });
  });
}

shaftcull_status shaftcull_classify(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                    const shaftcull_query* query, uint64_t* kept, uint64_t* inside, uint64_t words) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint64_t> not_outside = as_span(kept, words, "kept");
    const std::span<uint64_t> within = as_span(inside, words, "inside");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto& option) {
      shaftcull::classify(asked, set, not_outside, within, option);
    });
  });
}

shaftcull_status shaftcull_contained(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                     const shaftcull_query* query, uint64_t* inside, uint64_t words) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint64_t> out = as_span(inside, words, "inside");
    ask_bounds(bounds, query, takes_bounds, [&]<BoundSet Set>(const Set& set, const auto& option) {
      if constexpr (FlatSet<Set>) {
        shaftcull::contained(asked, set, out);
      } else {
        shaftcull::contained(asked, set, out, option);
      }
    });
  });
}

shaftcull_status shaftcull_count(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                 const shaftcull_query* query, uint64_t* kept_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint64_t& out = given(kept_count, "kept_count");
    ask_bounds(bounds, query, takes_any,
               [&](const AnySet auto& set, const auto& option) { out = shaftcull::count(asked, set, option); });
  });
}

shaftcull_status shaftcull_count_at_most(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                         const shaftcull_query* query, uint64_t most, uint64_t* kept_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint64_t& out = given(kept_count, "kept_count");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto& option) {
      out = shaftcull::count_at_most(asked, set, as_size(most, "most"), option);
    });
  });
}

shaftcull_status shaftcull_count_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                            const shaftcull_bounds* bounds, const shaftcull_query* query,
                                            shaftcull_kept_counts* counts) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    shaftcull_kept_counts& out = given(counts, "counts");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto& option) {
      out = from_counts(shaftcull::count_classified(asked, set, option));
    });
  });
}

shaftcull_status shaftcull_any(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                               const shaftcull_query* query, uint32_t* any) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint32_t& out = given(any, "any");
    ask_bounds(bounds, query, takes_any,
               [&](const AnySet auto& set, const auto& option) { out = shaftcull::any(asked, set, option) ? 1 : 0; });
  });
}

shaftcull_status shaftcull_list(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                const shaftcull_query* query, uint32_t* kept, uint64_t room, uint64_t* kept_count) {
  return list(shafts, shaft, bounds, query, kept, room, kept_count);
}

shaftcull_status shaftcull_list64(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                  const shaftcull_query* query, uint64_t* kept, uint64_t room, uint64_t* kept_count) {
  return list(shafts, shaft, bounds, query, kept, room, kept_count);
}

shaftcull_status shaftcull_list_ranges(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                       const shaftcull_query* query, shaftcull_leaf_range* kept, uint64_t room,
                                       uint64_t* range_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<shaftcull_leaf_range> out = as_span(kept, room, "kept");
    uint64_t& count = given(range_count, "range_count");
    ask_bounds(bounds, query, takes_trees, [&]<TreeSet Set>(const Set& set, const auto& option) {
      using Index = typename IndexOfSet<Set>::Type;
      const Written<LeafRangeOf<Index>> ranges(out.size());
      count = shaftcull::list(asked, set, ranges.span(), option);
      ranges.copy_to(out, static_cast<std::size_t>(count), from_range<Index>);
    });
  });
}

shaftcull_status shaftcull_list_at_most(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                        const shaftcull_query* query, uint32_t* kept, uint64_t room,
                                        uint64_t* kept_count) {
  return list_at_most(shafts, shaft, bounds, query, kept, room, kept_count);
}

shaftcull_status shaftcull_list_at_most64(const shaftcull_shafts* shafts, uint64_t shaft,
                                          const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* kept,
                                          uint64_t room, uint64_t* kept_count) {
  return list_at_most(shafts, shaft, bounds, query, kept, room, kept_count);
}

shaftcull_status shaftcull_list_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                           const shaftcull_bounds* bounds, const shaftcull_query* query,
                                           uint32_t* overlap, uint64_t overlap_room, uint32_t* inside,
                                           uint64_t inside_room, shaftcull_kept_counts* counts) {
  return list_classified(shafts, shaft, bounds, query, overlap, overlap_room, inside, inside_room, counts);
}

shaftcull_status shaftcull_list_classified64(const shaftcull_shafts* shafts, uint64_t shaft,
                                             const shaftcull_bounds* bounds, const shaftcull_query* query,
                                             uint64_t* overlap, uint64_t overlap_room, uint64_t* inside,
                                             uint64_t inside_room, shaftcull_kept_counts* counts) {
  return list_classified(shafts, shaft, bounds, query, overlap, overlap_room, inside, inside_room, counts);
}

shaftcull_status shaftcull_list_classified_ranges(const shaftcull_shafts* shafts, uint64_t shaft,
                                                  const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                  shaftcull_leaf_range* overlap, uint64_t overlap_room,
                                                  shaftcull_leaf_range* inside, uint64_t inside_room,
                                                  shaftcull_kept_counts* counts) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<shaftcull_leaf_range> overlapping = as_span(overlap, overlap_room, "overlap");
    const std::span<shaftcull_leaf_range> within = as_span(inside, inside_room, "inside");
    shaftcull_kept_counts& out = given(counts, "counts");
    ask_bounds(bounds, query, takes_trees, [&]<TreeSet Set>(const Set& set, const auto& option) {
      using Index = typename IndexOfSet<Set>::Type;
      const Written<LeafRangeOf<Index>> some(overlapping.size());
      const Written<LeafRangeOf<Index>> others(within.size());
      const KeptCounts found = shaftcull::list_classified(asked, set, some.span(), others.span(), option);
      some.copy_to(overlapping, found.overlap, from_range<Index>);
      others.copy_to(within, found.inside, from_range<Index>);
      out = from_counts(found);
    });
  });
}

}  // extern "C"
