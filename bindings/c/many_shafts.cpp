// SPDX-License-Identifier: MIT
/// Many shafts against many bounds: bits, counts and lists.
#include <cstdint>
#include <span>

#include "ask.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::KeptCounts;

extern "C" {

shaftcull_status shaftcull_cull_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                     const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* kept_rows,
                                     uint64_t words) {
  return guarded([&] {
    shaftcull::cull_many(shafts_of(shafts, first, count), bounds_of(bounds), as_span(kept_rows, words, "kept_rows"),
                         query_of(query));
  });
}

shaftcull_status shaftcull_classify_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                         const shaftcull_bounds* bounds, const shaftcull_query* query,
                                         uint64_t* kept_rows, uint64_t* inside_rows, uint64_t words) {
  return guarded([&] {
    shaftcull::classify_many(shafts_of(shafts, first, count), bounds_of(bounds),
                             as_span_if_given(kept_rows, words, "kept_rows"),
                             as_span(inside_rows, words, "inside_rows"), query_of(query));
  });
}

shaftcull_status shaftcull_count_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                      const shaftcull_bounds* bounds, const shaftcull_query* query,
                                      uint64_t* kept_counts) {
  return guarded([&] {
    shaftcull::count_many(shafts_of(shafts, first, count), bounds_of(bounds),
                          as_span(kept_counts, count, "kept_counts"), query_of(query));
  });
}

shaftcull_status shaftcull_count_classified_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                 const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                 shaftcull_kept_counts* counts) {
  return guarded([&] {
    const std::span<shaftcull_kept_counts> out = as_span(counts, count, "counts");
    const Written<KeptCounts> found(out.size());
    shaftcull::count_classified_many(shafts_of(shafts, first, count), bounds_of(bounds), found.span(), query_of(query));
    found.copy_to(out, from_counts);
  });
}

shaftcull_status shaftcull_any_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                    const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* any,
                                    uint64_t words) {
  return guarded([&] {
    shaftcull::any_many(shafts_of(shafts, first, count), bounds_of(bounds), as_span(any, words, "any"),
                        query_of(query));
  });
}

shaftcull_status shaftcull_list_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                     const shaftcull_bounds* bounds, const shaftcull_query* query,
                                     shaftcull_lists* lists) {
  return guarded([&] {
    shaftcull::list_many(shafts_of(shafts, first, count), bounds_of(bounds), given(lists, "lists").lists,
                         query_of(query));
  });
}

shaftcull_status shaftcull_list_classified_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                shaftcull_lists* overlap, shaftcull_lists* inside) {
  return guarded([&] {
    shaftcull::list_classified_many(shafts_of(shafts, first, count), bounds_of(bounds), given(overlap, "overlap").lists,
                                    given(inside, "inside").lists, query_of(query));
  });
}

}  // extern "C"
