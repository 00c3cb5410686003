// SPDX-License-Identifier: MIT
/// First contact, entry times, and refining of candidates.
#include <cstdint>
#include <span>

#include "ask.hpp"
#include "lists.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::CompiledShaft;
using shaftcull::FirstContact;
using shaftcull::IndexLists;

extern "C" {

shaftcull_status shaftcull_first_contact(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                         const shaftcull_query* query, shaftcull_contact_found* contact) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    shaftcull_contact_found& out = given(contact, "contact");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      out = from_contact(shaftcull::first_contact(asked, set, option...));
    });
  });
}

shaftcull_status shaftcull_first_contact_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              shaftcull_contact_found* contacts) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<shaftcull_contact_found> out = as_span(contacts, count, "contacts");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto&... option) {
      const Written<FirstContact> found(out.size());
      shaftcull::first_contact_many(asked, set, found.span(), option...);
      found.copy_to(out, out.size(), from_contact);
    });
  });
}

shaftcull_status shaftcull_entry_times(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                       const uint32_t* indices, float* times, uint64_t count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<const uint32_t> which = as_span(indices, count, "indices");
    const std::span<float> out = as_span(times, count, "times");
    use_bounds(bounds, takes_bounds, [&](const BoundSet auto& set) { shaftcull::entry_times(asked, set, which, out); });
  });
}

shaftcull_status shaftcull_refine(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                  const uint32_t* candidates, uint64_t count, uint32_t* kept, uint64_t room,
                                  uint64_t* kept_count) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<const uint32_t> which = as_span(candidates, count, "candidates");
    const std::span<uint32_t> out = as_span(kept, room, "kept");
    uint64_t& found = given(kept_count, "kept_count");
    use_bounds(bounds, takes_bounds,
               [&](const BoundSet auto& set) { found = shaftcull::refine(asked, set, which, out); });
  });
}

shaftcull_status shaftcull_refine_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                       const shaftcull_bounds* bounds, const uint32_t* candidates,
                                       uint64_t candidate_count, shaftcull_lists* lists) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<const uint32_t> which = as_span(candidates, candidate_count, "candidates");
    IndexLists& out = index_lists_of(lists);
    use_bounds(bounds, takes_bounds, [&](const BoundSet auto& set) { shaftcull::refine_many(asked, set, which, out); });
  });
}

}  // extern "C"
