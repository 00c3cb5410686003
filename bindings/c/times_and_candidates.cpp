// SPDX-License-Identifier: MIT
/// First contact, entry times, and refining of candidates.
#include <cstdint>
#include <span>

#include "ask.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::CompiledShaft;
using shaftcull::FirstContactOf;
using shaftcull::IndexListsOf;

namespace {

template <class Index>
shaftcull_status entry_times(const shaftcull_shafts* shafts, std::uint64_t shaft, const shaftcull_bounds* bounds,
                             const Index* indices, float* times, std::uint64_t count) noexcept {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<const Index> which = as_span(indices, count, "indices");
    const std::span<float> out = as_span(times, count, "times");
    use_bounds(
        bounds, takes_width<Index>, [&]<class Set>(const Set& set) requires(BoundSet<Set> && ListedBy<Set, Index>) {
          shaftcull::entry_times(asked, set, which, out);
        });
  });
}

template <class Index>
shaftcull_status refine(const shaftcull_shafts* shafts, std::uint64_t shaft, const shaftcull_bounds* bounds,
                        const Index* candidates, std::uint64_t count, Index* kept, std::uint64_t room,
                        std::uint64_t* kept_count) noexcept {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    const std::span<const Index> which = as_span(candidates, count, "candidates");
    const std::span<Index> out = as_span(kept, room, "kept");
    std::uint64_t& found = given(kept_count, "kept_count");
    use_bounds(
        bounds, takes_width<Index>, [&]<class Set>(const Set& set) requires(BoundSet<Set> && ListedBy<Set, Index>) {
          found = shaftcull::refine(asked, set, which, out);
        });
  });
}

template <class Index>
shaftcull_status refine_many(const shaftcull_shafts* shafts, std::uint64_t first, std::uint64_t count,
                             const shaftcull_bounds* bounds, const Index* candidates, std::uint64_t candidate_count,
                             shaftcull_lists* lists) noexcept {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<const Index> which = as_span(candidates, candidate_count, "candidates");
    auto* const out = std::get_if<IndexListsOf<Index>>(&given(lists, "lists").lists);
    if (out == nullptr) {
      refuse("lists are not of indices of the candidates' width; shaftcull_lists_create() makes such by " +
             std::string(sizeof(Index) == 4 ? "SHAFTCULL_LISTS_OF_INDICES" : "SHAFTCULL_LISTS_OF_INDICES64"));
    }
    use_bounds(
        bounds, takes_width<Index>, [&]<class Set>(const Set& set) requires(BoundSet<Set> && ListedBy<Set, Index>) {
          shaftcull::refine_many(asked, set, which, *out);
        });
  });
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_first_contact(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                         const shaftcull_query* query, shaftcull_contact_found* contact) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    shaftcull_contact_found& out = given(contact, "contact");
    ask_bounds(bounds, query, takes_bounds, [&](const BoundSet auto& set, const auto& option) {
      out = from_contact(shaftcull::first_contact(asked, set, option));
    });
  });
}

shaftcull_status shaftcull_first_contact_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_bounds* bounds, const shaftcull_query* query,
                                              shaftcull_contact_found* contacts) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    const std::span<shaftcull_contact_found> out = as_span(contacts, count, "contacts");
    ask_bounds(bounds, query, takes_bounds, [&]<BoundSet Set>(const Set& set, const auto& option) {
      using Index = typename IndexOfSet<Set>::Type;  // void of a view
      using Found = FirstContactOf<std::conditional_t<std::is_void_v<Index>, std::uint64_t, Index>>;
      const Written<Found> found(out.size());
      shaftcull::first_contact_many(asked, set, found.span(), option);
      found.copy_to(out, out.size(), [](const Found& one) { return from_contact(one); });
    });
  });
}

shaftcull_status shaftcull_entry_times(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                       const uint32_t* indices, float* times, uint64_t count) {
  return entry_times(shafts, shaft, bounds, indices, times, count);
}

shaftcull_status shaftcull_entry_times64(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                         const uint64_t* indices, float* times, uint64_t count) {
  return entry_times(shafts, shaft, bounds, indices, times, count);
}

shaftcull_status shaftcull_refine(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                  const uint32_t* candidates, uint64_t count, uint32_t* kept, uint64_t room,
                                  uint64_t* kept_count) {
  return refine(shafts, shaft, bounds, candidates, count, kept, room, kept_count);
}

shaftcull_status shaftcull_refine64(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                    const uint64_t* candidates, uint64_t count, uint64_t* kept, uint64_t room,
                                    uint64_t* kept_count) {
  return refine(shafts, shaft, bounds, candidates, count, kept, room, kept_count);
}

shaftcull_status shaftcull_refine_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                       const shaftcull_bounds* bounds, const uint32_t* candidates,
                                       uint64_t candidate_count, shaftcull_lists* lists) {
  return refine_many(shafts, first, count, bounds, candidates, candidate_count, lists);
}

shaftcull_status shaftcull_refine_many64(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                         const shaftcull_bounds* bounds, const uint64_t* candidates,
                                         uint64_t candidate_count, shaftcull_lists* lists) {
  return refine_many(shafts, first, count, bounds, candidates, candidate_count, lists);
}

}  // extern "C"
