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
using shaftcull::LeafRange;

extern "C" {

shaftcull_status shaftcull_cull(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                const shaftcull_query* query, uint64_t* kept, uint64_t words) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint64_t> out = as_span(kept, words, "kept");
    ask_bounds(bounds, query, takes_any,
               [&](const AnySet auto& set, const auto&... option) { shaftcull::cull(asked, set, out, option...); });
  });
}

shaftcull_status shaftcull_classify(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                    const shaftcull_query* query, uint64_t* kept, uint64_t* inside, uint64_t words) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint64_t> not_outside = as_span(kept, words, "kept");
    const std::span<uint64_t> within = as_span(inside, words, "inside");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      shaftcull::classify(asked, set, not_outside, within, option...);
    });
  });
}

shaftcull_status shaftcull_contained(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                     const shaftcull_query* query, uint64_t* inside, uint64_t words) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint64_t> out = as_span(inside, words, "inside");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      shaftcull::contained(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_count(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                 const shaftcull_query* query, uint64_t* kept_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint64_t& out = given(kept_count, "kept_count");
    ask_bounds(bounds, query, takes_any,
               [&](const AnySet auto& set, const auto&... option) { out = shaftcull::count(asked, set, option...); });
  });
}

shaftcull_status shaftcull_count_at_most(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                         const shaftcull_query* query, uint64_t most, uint64_t* kept_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint64_t& out = given(kept_count, "kept_count");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      out = shaftcull::count_at_most(asked, set, as_size(most, "most"), option...);
    });
  });
}

shaftcull_status shaftcull_count_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                            const shaftcull_bounds* bounds, const shaftcull_query* query,
                                            shaftcull_kept_counts* counts) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    shaftcull_kept_counts& out = given(counts, "counts");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      out = from_counts(shaftcull::count_classified(asked, set, option...));
    });
  });
}

shaftcull_status shaftcull_any(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                               const shaftcull_query* query, uint32_t* any) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint32_t& out = given(any, "any");
    ask_bounds(bounds, query, takes_any, [&](const AnySet auto& set, const auto&... option) {
      out = shaftcull::any(asked, set, option...) ? 1 : 0;
    });
  });
}

shaftcull_status shaftcull_list(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                const shaftcull_query* query, uint32_t* kept, uint64_t room, uint64_t* kept_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint32_t> out = as_span(kept, room, "kept");
    uint64_t& count = given(kept_count, "kept_count");
    ask_bounds(bounds, query, takes_any, [&](const AnySet auto& set, const auto&... option) {
      count = shaftcull::list(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_list_ranges(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                       const shaftcull_query* query, shaftcull_leaf_range* kept, uint64_t room,
                                       uint64_t* range_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<shaftcull_leaf_range> out = as_span(kept, room, "kept");
    uint64_t& count = given(range_count, "range_count");
    ask_bounds(bounds, query, takes_trees, [&](const TreeSet auto& set, const auto&... option) {
      const Written<LeafRange> ranges(out.size());
      count = shaftcull::list(asked, set, ranges.span(), option...);
      ranges.copy_to(out, static_cast<std::size_t>(count), from_range);
    });
  });
}

shaftcull_status shaftcull_list_at_most(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                        const shaftcull_query* query, uint32_t* kept, uint64_t room,
                                        uint64_t* kept_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint32_t> out = as_span(kept, room, "kept");
    uint64_t& count = given(kept_count, "kept_count");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      count = shaftcull::list_at_most(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_list_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                           const shaftcull_bounds* bounds, const shaftcull_query* query,
                                           uint32_t* overlap, uint64_t overlap_room, uint32_t* inside,
                                           uint64_t inside_room, shaftcull_kept_counts* counts) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint32_t> overlapping = as_span(overlap, overlap_room, "overlap");
    const std::span<uint32_t> within = as_span(inside, inside_room, "inside");
    shaftcull_kept_counts& out = given(counts, "counts");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      out = from_counts(shaftcull::list_classified(asked, set, overlapping, within, option...));
    });
  });
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
    ask_bounds(bounds, query, takes_trees, [&](const TreeSet auto& set, const auto&... option) {
      const Written<LeafRange> some(overlapping.size());
      const Written<LeafRange> others(within.size());
      const KeptCounts found = shaftcull::list_classified(asked, set, some.span(), others.span(), option...);
      some.copy_to(overlapping, found.overlap, from_range);
      others.copy_to(within, found.inside, from_range);
      out = from_counts(found);
    });
  });
}

}  // extern "C"
