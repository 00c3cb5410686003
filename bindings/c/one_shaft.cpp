// SPDX-License-Identifier: MIT
/// One shaft against many bounds: bits, counts and lists.
#include <cstdint>

#include "ask.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;

extern "C" {

shaftcull_status shaftcull_cull(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                const shaftcull_query* query, uint64_t* kept, uint64_t words) {
  return guarded([&] {
    shaftcull::cull(shaft_at(shafts, shaft), bounds_of(bounds), as_span(kept, words, "kept"), query_of(query));
  });
}

shaftcull_status shaftcull_classify(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                    const shaftcull_query* query, uint64_t* kept, uint64_t* inside, uint64_t words) {
  return guarded([&] {
    shaftcull::classify(shaft_at(shafts, shaft), bounds_of(bounds), as_span_if_given(kept, words, "kept"),
                        as_span(inside, words, "inside"), query_of(query));
  });
}

shaftcull_status shaftcull_count(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                 const shaftcull_query* query, uint64_t* kept_count) {
  return guarded([&] {
    uint64_t& out = given(kept_count, "kept_count");
    out = shaftcull::count(shaft_at(shafts, shaft), bounds_of(bounds), query_of(query));
  });
}

shaftcull_status shaftcull_count_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                            const shaftcull_bounds* bounds, const shaftcull_query* query,
                                            shaftcull_kept_counts* counts) {
  return guarded([&] {
    shaftcull_kept_counts& out = given(counts, "counts");
    out = from_counts(shaftcull::count_classified(shaft_at(shafts, shaft), bounds_of(bounds), query_of(query)));
  });
}

shaftcull_status shaftcull_any(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                               const shaftcull_query* query, uint32_t* any) {
  return guarded([&] {
    uint32_t& out = given(any, "any");
    out = shaftcull::any(shaft_at(shafts, shaft), bounds_of(bounds), query_of(query)) ? 1 : 0;
  });
}

shaftcull_status shaftcull_list(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                const shaftcull_query* query, uint32_t* kept, uint64_t room, uint64_t* kept_count) {
  return guarded([&] {
    uint64_t& out = given(kept_count, "kept_count");
    out = shaftcull::list(shaft_at(shafts, shaft), bounds_of(bounds), as_span(kept, room, "kept"), query_of(query));
  });
}

shaftcull_status shaftcull_list_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                           const shaftcull_bounds* bounds, const shaftcull_query* query,
                                           uint32_t* overlap, uint64_t overlap_room, uint32_t* inside,
                                           uint64_t inside_room, shaftcull_kept_counts* counts) {
  return guarded([&] {
    shaftcull_kept_counts& out = given(counts, "counts");
    out = from_counts(shaftcull::list_classified(shaft_at(shafts, shaft), bounds_of(bounds),
                                                 as_span(overlap, overlap_room, "overlap"),
                                                 as_span(inside, inside_room, "inside"), query_of(query)));
  });
}

}  // extern "C"
