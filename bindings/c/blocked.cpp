// SPDX-License-Identifier: MIT
/// Which solid boxes hide one end of a shaft from the other.
#include <cstdint>
#include <span>

#include "ask.hpp"
#include "lists.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::CompiledShaft;

extern "C" {

shaftcull_status shaftcull_blocked(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                   const shaftcull_query* query, uint32_t* blocked) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint32_t& out = given(blocked, "blocked");
    ask_bounds(solids, query, takes_boxes, [&](const BoxSet auto& set, const auto&... option) {
      out = shaftcull::blocked(asked, set, option...) ? 1 : 0;
    });
  });
}

shaftcull_status shaftcull_blocked_by(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                      const shaftcull_query* query, uint64_t* index) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint64_t& out = given(index, "index");
    ask_bounds(solids, query, takes_boxes, [&](const BoxSet auto& set, const auto&... option) {
      const auto found = shaftcull::blocked_by(asked, set, option...);
      out = found ? *found : SHAFTCULL_NONE;
    });
  });
}

shaftcull_status shaftcull_list_blocking(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* solids,
                                         const shaftcull_query* query, uint32_t* blocking, uint64_t room,
                                         uint64_t* blocking_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<uint32_t> out = as_span(blocking, room, "blocking");
    uint64_t& count = given(blocking_count, "blocking_count");
    ask_bounds(solids, query, takes_boxes, [&](const BoxSet auto& set, const auto&... option) {
      count = shaftcull::list_blocking(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_blocked_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                        const shaftcull_bounds* solids, const shaftcull_query* query, uint64_t* blocked,
                                        uint64_t words) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<uint64_t> out = as_span(blocked, words, "blocked");
    ask_bounds(solids, query, takes_boxes, [&](const BoxSet auto& set, const auto&... option) {
      shaftcull::blocked_many(asked, set, out, option...);
    });
  });
}

shaftcull_status shaftcull_list_blocking_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_bounds* solids, const shaftcull_query* query,
                                              shaftcull_lists* lists) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    shaftcull::IndexLists& out = index_lists_of(lists);
    ask_bounds(solids, query, takes_boxes, [&](const BoxSet auto& set, const auto&... option) {
      shaftcull::list_blocking_many(asked, set, out, option...);
    });
  });
}

}  // extern "C"
