// SPDX-License-Identifier: MIT
/// Which solid boxes hide one end of a shaft from the other.
#include <cstdint>

#include "ask.hpp"
#include "status.hpp"

using namespace shaftcull::binding;

extern "C" {

shaftcull_status shaftcull_blocked(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                   const shaftcull_query* query, uint32_t* blocked) {
  return guarded([&] {
    uint32_t& out = given(blocked, "blocked");
    out = shaftcull::blocked(shaft_at(shafts, shaft), bounds_of(solids, "solids"), query_of(query)) ? 1 : 0;
  });
}

shaftcull_status shaftcull_blocked_by(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                      const shaftcull_query* query, uint64_t* index) {
  return guarded([&] {
    uint64_t& out = given(index, "index");
    const auto found = shaftcull::blocked_by(shaft_at(shafts, shaft), bounds_of(solids, "solids"), query_of(query));
    out = found ? *found : SHAFTCULL_NONE;
  });
}

shaftcull_status shaftcull_list_blocking(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                         const shaftcull_query* query, uint32_t* blocking, uint64_t room,
                                         uint64_t* blocking_count) {
  return guarded([&] {
    uint64_t& out = given(blocking_count, "blocking_count");
    out = shaftcull::list_blocking(shaft_at(shafts, shaft), bounds_of(solids, "solids"),
                                   as_span(blocking, room, "blocking"), query_of(query));
  });
}

shaftcull_status shaftcull_blocked_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                        const shaftcull_bounds* solids, const shaftcull_query* query, uint64_t* blocked,
                                        uint64_t words) {
  return guarded([&] {
    shaftcull::blocked_many(shafts_of(shafts, first, count), bounds_of(solids, "solids"),
                            as_span(blocked, words, "blocked"), query_of(query));
  });
}

shaftcull_status shaftcull_list_blocking_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_bounds* solids, const shaftcull_query* query,
                                              shaftcull_lists* lists) {
  return guarded([&] {
    shaftcull::list_blocking_many(shafts_of(shafts, first, count), bounds_of(solids, "solids"),
                                  given(lists, "lists").lists, query_of(query));
  });
}

}  // extern "C"
