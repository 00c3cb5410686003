// SPDX-License-Identifier: MIT
/// First contact and entry times.
#include <cstdint>
#include <span>

#include "ask.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::FirstContact;

extern "C" {

shaftcull_status shaftcull_first_contact(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                         const shaftcull_query* query, shaftcull_contact_found* contact) {
  return guarded([&] {
    shaftcull_contact_found& out = given(contact, "contact");
    out = from_contact(shaftcull::first_contact(shaft_at(shafts, shaft), bounds_of(bounds), query_of(query)));
  });
}

shaftcull_status shaftcull_first_contact_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              shaftcull_contact_found* contacts) {
  return guarded([&] {
    const std::span<shaftcull_contact_found> out = as_span(contacts, count, "contacts");
    const Written<FirstContact> found(out.size());
    shaftcull::first_contact_many(shafts_of(shafts, first, count), bounds_of(bounds), found.span(), query_of(query));
    found.copy_to(out, from_contact);
  });
}

shaftcull_status shaftcull_entry_times(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                       const uint32_t* indices, float* times, uint64_t count) {
  return guarded([&] {
    shaftcull::entry_times(shaft_at(shafts, shaft), bounds_of(bounds), as_span(indices, count, "indices"),
                           as_span(times, count, "times"));
  });
}

}  // extern "C"
