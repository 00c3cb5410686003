// SPDX-License-Identifier: MIT
/// Many shafts against many bounds: bits, counts and lists.
#include <cstdint>
#include <span>
#include <utility>

#include "ask.hpp"
#include "lists.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::CompiledShaft;
using shaftcull::IndexLists;
using shaftcull::KeptCounts;
using shaftcull::LeafRangeLists;

namespace {

/// Fills lists of ranges from a tree.
void list_ranges(std::span<const CompiledShaft> shafts, const shaftcull_bounds* bounds, const shaftcull_query* query,
                 RangeLists& lists) {
  ask_bounds(bounds, query, takes_trees, [&](const TreeSet auto& set, const auto&... option) {
    LeafRangeLists found;
    shaftcull::list_many(shafts, set, found, option...);
    lists = from_range_lists(std::move(found));
  });
}

void list_classified_ranges(std::span<const CompiledShaft> shafts, const shaftcull_bounds* bounds,
                            const shaftcull_query* query, RangeLists& overlap, RangeLists& inside) {
  if (&overlap == &inside) refuse("overlap and inside are the same lists; each needs its own");
  ask_bounds(bounds, query, takes_trees, [&](const TreeSet auto& set, const auto&... option) {
    LeafRangeLists some;
    LeafRangeLists others;
    shaftcull::list_classified_many(shafts, set, some, others, option...);
    RangeLists overlapping = from_range_lists(std::move(some));
    inside = from_range_lists(std::move(others));
    overlap = std::move(overlapping);
  });
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_cull_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                     const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* kept_rows,
                                     uint64_t words) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<uint64_t> out = as_span(kept_rows, words, "kept_rows");
    ask_bounds(bounds, query, takes_any, [&](const AnySet auto& set, const auto&... option) {
      shaftcull::cull_many(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_classify_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                         const shaftcull_bounds* bounds, const shaftcull_query* query,
                                         uint64_t* kept_rows, uint64_t* inside_rows, uint64_t words) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<uint64_t> not_outside = as_span(kept_rows, words, "kept_rows");
    const std::span<uint64_t> within = as_span(inside_rows, words, "inside_rows");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      shaftcull::classify_many(asked, set, not_outside, within, option...);
    });
  });
}

shaftcull_status shaftcull_contained_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                          const shaftcull_bounds* bounds, const shaftcull_query* query,
                                          uint64_t* inside_rows, uint64_t words) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<uint64_t> out = as_span(inside_rows, words, "inside_rows");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      shaftcull::contained_many(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_count_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                      const shaftcull_bounds* bounds, const shaftcull_query* query,
                                      uint64_t* kept_counts) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<uint64_t> out = as_span(kept_counts, count, "kept_counts");
    ask_bounds(bounds, query, takes_any, [&](const AnySet auto& set, const auto&... option) {
      shaftcull::count_many(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_count_at_most_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              uint64_t most, uint64_t* kept_counts) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<uint64_t> out = as_span(kept_counts, count, "kept_counts");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      shaftcull::count_at_most_many(asked, set, as_size(most, "most"), out, option...);
    });
  });
}

shaftcull_status shaftcull_count_classified_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                 const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                 shaftcull_kept_counts* counts) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<shaftcull_kept_counts> out = as_span(counts, count, "counts");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      const Written<KeptCounts> found(out.size());
      shaftcull::count_classified_many(asked, set, found.span(), option...);
      found.copy_to(out, out.size(), from_counts);
    });
  });
}

shaftcull_status shaftcull_any_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                    const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* any,
                                    uint64_t words) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<uint64_t> out = as_span(any, words, "any");
    ask_bounds(bounds, query, takes_any,
               [&](const AnySet auto& set, const auto&... option) { shaftcull::any_many(asked, set, out, option...); });
  });
}

shaftcull_status shaftcull_list_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                     const shaftcull_bounds* bounds, const shaftcull_query* query,
                                     shaftcull_lists* lists) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    if (auto* const ranges = std::get_if<RangeLists>(&given(lists, "lists").lists)) {
      list_ranges(asked, bounds, query, *ranges);
      return;
    }
    IndexLists& out = index_lists_of(lists);
    ask_bounds(bounds, query, takes_any, [&](const AnySet auto& set, const auto&... option) {
      shaftcull::list_many(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_list_classified_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                shaftcull_lists* overlap, shaftcull_lists* inside) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    if (given(overlap, "overlap").lists.index() != given(inside, "inside").lists.index()) {
      refuse("overlap and inside are lists of different kinds");
    }
    if (auto* const ranges = std::get_if<RangeLists>(&overlap->lists)) {
      list_classified_ranges(asked, bounds, query, *ranges, std::get<RangeLists>(inside->lists));
      return;
    }
    IndexLists& overlapping = index_lists_of(overlap);
    IndexLists& within = index_lists_of(inside);
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      shaftcull::list_classified_many(asked, set, overlapping, within, option...);
    });
  });
}

shaftcull_status shaftcull_list_at_most_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                             const shaftcull_bounds* bounds, const shaftcull_query* query,
                                             uint64_t most, uint32_t* kept, uint64_t* kept_counts) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    if (most != 0 && count > std::numeric_limits<uint64_t>::max() / most) {
      refuse("most = " + std::to_string(most) + " indices for each of " + std::to_string(count) +
             " shafts are more than memory can hold");
    }
    const std::span<uint32_t> out = as_span(kept, count * most, "kept");
    const std::span<uint64_t> counts = as_span(kept_counts, count, "kept_counts");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      shaftcull::list_at_most_many(asked, set, as_size(most, "most"), out, counts, option...);
    });
  });
}

}  // extern "C"
