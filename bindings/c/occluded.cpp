// SPDX-License-Identifier: MIT
/// Which solid boxes hide one end of a shaft from the other.
#include <cstdint>

#include "ask.hpp"
#include "status.hpp"

using namespace shaftcull::binding;

extern "C" {

shaftcull_status shaftcull_occluded(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                    const shaftcull_query* query, uint32_t* occluded) {
  return guarded([&] {
    uint32_t& out = given(occluded, "occluded");
    out = shaftcull::occluded(shaft_at(shafts, shaft), bounds_of(solids, "solids"), query_of(query)) ? 1 : 0;
  });
}

shaftcull_status shaftcull_find_occluder(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                         const shaftcull_query* query, uint64_t* index) {
  return guarded([&] {
    uint64_t& out = given(index, "index");
    const auto found = shaftcull::find_occluder(shaft_at(shafts, shaft), bounds_of(solids, "solids"), query_of(query));
    out = found ? *found : SHAFTCULL_NONE;
  });
}

shaftcull_status shaftcull_list_occluders(const shaftcull_shafts* shafts, uint64_t shaft,
                                          const shaftcull_bounds* solids, const shaftcull_query* query,
                                          uint32_t* blocking, uint64_t room, uint64_t* blocking_count) {
  return guarded([&] {
    uint64_t& out = given(blocking_count, "blocking_count");
    out = shaftcull::list_occluders(shaft_at(shafts, shaft), bounds_of(solids, "solids"),
                                    as_span(blocking, room, "blocking"), query_of(query));
  });
}

shaftcull_status shaftcull_occluded_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                         const shaftcull_bounds* solids, const shaftcull_query* query,
                                         uint64_t* occluded, uint64_t words) {
  return guarded([&] {
    shaftcull::occluded_many(shafts_of(shafts, first, count), bounds_of(solids, "solids"),
                             as_span(occluded, words, "occluded"), query_of(query));
  });
}

shaftcull_status shaftcull_list_occluders_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                               const shaftcull_bounds* solids, const shaftcull_query* query,
                                               shaftcull_lists* lists) {
  return guarded([&] {
    shaftcull::list_occluders_many(shafts_of(shafts, first, count), bounds_of(solids, "solids"),
                                   given(lists, "lists").lists, query_of(query));
  });
}

}  // extern "C"
