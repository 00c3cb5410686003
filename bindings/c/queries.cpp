// SPDX-License-Identifier: MIT
/// Queries. One shaft goes to the C++ call for one, on this thread; several go to the call for many.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Bounds;
using shaftcull::CompiledShaft;
using shaftcull::FirstContact;
using shaftcull::KeptCounts;
using shaftcull::Query;

namespace {

/// Bounds with their layers.
Bounds bounds_of(const shaftcull_bounds* bounds, const char* name) {
  const shaftcull_bounds& all = given(bounds, name);
  return std::visit(
      [&all](const auto& holder) -> Bounds {
        if constexpr (requires { Bounds(holder, all.layers); }) {
          return Bounds(holder, all.layers);
        } else {
          return holder;
        }
      },
      all.holder);
}

/// The options of a query, which may be NULL. The C++ interface checks their values.
Query query_of(const shaftcull_query* query) {
  static constexpr shaftcull_query everything{};
  const shaftcull_query& asked = query == nullptr ? everything : *query;
  if (asked.skip_overlapping > 1) {
    refuse("query.skip_overlapping = " + std::to_string(asked.skip_overlapping) + " is neither 0 nor 1");
  }
  require_zero(asked.reserved, "query");
  std::optional<std::span<const std::uint32_t>> only;
  if (asked.only != nullptr || asked.only_count != 0) only = as_span(asked.only, asked.only_count, "query.only");
  const std::uint64_t limit = asked.limit == 0 ? Query::no_limit : asked.limit;
  return {.exclude = as_span(asked.exclude, asked.exclude_count, "query.exclude"),
          .exclude_each = as_span(asked.exclude_each, asked.exclude_each_count, "query.exclude_each"),
          .exclude_mask = as_span(asked.exclude_mask, asked.exclude_mask_words, "query.exclude_mask"),
          .layer_mask = as_span(asked.layer_masks, asked.layer_mask_count, "query.layer_masks"),
          .limit = static_cast<std::size_t>(std::min<std::uint64_t>(limit, Query::no_limit)),
          .only = only,
          .skip_overlapping = asked.skip_overlapping != 0,
          .triangle_test = as_triangle_test(asked.triangle_test)};
}

/// A query about a range of shafts.
struct Asked {
  std::span<const CompiledShaft> shafts;
  Bounds bounds;
  Query query;

  Asked(const shaftcull_shafts* array, std::uint64_t first, std::uint64_t count, const shaftcull_bounds* about,
        const char* name, const shaftcull_query* options)
      : shafts(shafts_from(array, first, count)), bounds(bounds_of(about, name)), query(query_of(options)) {}
  [[nodiscard]] bool is_one() const noexcept { return shafts.size() == 1; }
  [[nodiscard]] const CompiledShaft& one() const noexcept { return shafts.front(); }
};

shaftcull_kept_counts from_counts(const KeptCounts& counts) noexcept { return {counts.overlap, counts.inside}; }

shaftcull_contact_found from_contact(const FirstContact& contact) noexcept {
  const bool found = static_cast<bool>(contact);
  return {found ? std::uint64_t{contact.index} : SHAFTCULL_NONE,
          contact.time,
          found ? 1U : 0U,
          {contact.normal[0], contact.normal[1], contact.normal[2]},
          0};
}

/// Has call(elements) write as many elements as `out` has, and converts them.
template <class Element, class Out, class Call, class Convert>
void convert_written(std::span<Out> out, Call&& call, Convert&& convert) {
  const auto elements = std::make_unique_for_overwrite<Element[]>(out.size());
  call(std::span<Element>(elements.get(), out.size()));
  std::transform(elements.get(), elements.get() + out.size(), out.begin(), convert);
}

/// A value of the C++ interface at any address.
template <class Value>
Value read(const void* from) noexcept {
  Value value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// The C++ interface says of one triangle whether it is kept, and of triangles in views whether they are inside.
shaftcull_answer classify_triangle(const CompiledShaft& shaft, const shaftcull::Triangle& triangle,
                                   shaftcull::TriangleTest test) {
  if (!shaftcull::keeps(shaft, triangle, test)) return SHAFTCULL_OUTSIDE;
  shaftcull::TriangleView view;
  view.count = 1;
  for (std::size_t s = 0; s != view.stream.size(); ++s) view.stream[s] = &triangle.vertex[s / 3][s % 3];
  std::uint64_t inside = 0;
  shaftcull::classify(shaft, view, {}, {&inside, 1}, {.triangle_test = test});
  return inside != 0 ? SHAFTCULL_INSIDE : SHAFTCULL_OVERLAP;
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_cull(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* kept,
                                uint64_t words) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    const std::span<uint64_t> out = as_span(kept, words, "kept");
    if (asked.is_one()) {
      shaftcull::cull(asked.one(), asked.bounds, out, asked.query);
    } else {
      shaftcull::cull_many(asked.shafts, asked.bounds, out, asked.query);
    }
  });
}

shaftcull_status shaftcull_classify(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                    const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* kept,
                                    uint64_t* inside, uint64_t words) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    const std::span<uint64_t> kept_out = as_span_if_given(kept, words, "kept");
    const std::span<uint64_t> inside_out = as_span(inside, words, "inside");
    if (asked.is_one()) {
      shaftcull::classify(asked.one(), asked.bounds, kept_out, inside_out, asked.query);
    } else {
      shaftcull::classify_many(asked.shafts, asked.bounds, kept_out, inside_out, asked.query);
    }
  });
}

shaftcull_status shaftcull_count(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                 const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* kept_counts) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    const std::span<uint64_t> out = as_span(kept_counts, count, "kept_counts");
    if (asked.is_one()) {
      out[0] = shaftcull::count(asked.one(), asked.bounds, asked.query);
    } else {
      shaftcull::count_many(asked.shafts, asked.bounds, out, asked.query);
    }
  });
}

shaftcull_status shaftcull_count_classified(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                            const shaftcull_bounds* bounds, const shaftcull_query* query,
                                            shaftcull_kept_counts* counts) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    const std::span<shaftcull_kept_counts> out = as_span(counts, count, "counts");
    if (asked.is_one()) {
      out[0] = from_counts(shaftcull::count_classified(asked.one(), asked.bounds, asked.query));
      return;
    }
    convert_written<KeptCounts>(
        out,
        [&](std::span<KeptCounts> found) {
          shaftcull::count_classified_many(asked.shafts, asked.bounds, found, asked.query);
        },
        from_counts);
  });
}

shaftcull_status shaftcull_any(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                               const shaftcull_bounds* bounds, const shaftcull_query* query, uint64_t* any) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    const std::span<uint64_t> out = as_span(any, shaftcull_bit_words(count), "any");
    if (asked.is_one()) {
      out[0] = shaftcull::any(asked.one(), asked.bounds, asked.query) ? 1 : 0;
    } else {
      shaftcull::any_many(asked.shafts, asked.bounds, out, asked.query);
    }
  });
}

shaftcull_status shaftcull_first_contact(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                         const shaftcull_bounds* bounds, const shaftcull_query* query,
                                         shaftcull_contact_found* contacts) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    const std::span<shaftcull_contact_found> out = as_span(contacts, count, "contacts");
    if (asked.is_one()) {
      out[0] = from_contact(shaftcull::first_contact(asked.one(), asked.bounds, asked.query));
      return;
    }
    convert_written<FirstContact>(
        out,
        [&](std::span<FirstContact> found) {
          shaftcull::first_contact_many(asked.shafts, asked.bounds, found, asked.query);
        },
        from_contact);
  });
}

shaftcull_status shaftcull_occluded(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                    const shaftcull_bounds* solids, const shaftcull_query* query, uint64_t* occluded) {
  return guarded([&] {
    const Asked asked(shafts, first, count, solids, "solids", query);
    const std::span<uint64_t> out = as_span(occluded, shaftcull_bit_words(count), "occluded");
    if (asked.is_one()) {
      out[0] = shaftcull::occluded(asked.one(), asked.bounds, asked.query) ? 1 : 0;
    } else {
      shaftcull::occluded_many(asked.shafts, asked.bounds, out, asked.query);
    }
  });
}

shaftcull_status shaftcull_list(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                const shaftcull_query* query, uint32_t* kept, uint64_t room, uint64_t* kept_count) {
  return guarded([&] {
    uint64_t& out = given(kept_count, "kept_count");
    out = shaftcull::list(shaft_at(shafts, shaft), bounds_of(bounds, "bounds"), as_span(kept, room, "kept"),
                          query_of(query));
  });
}

shaftcull_status shaftcull_list_classified(const shaftcull_shafts* shafts, uint64_t shaft,
                                           const shaftcull_bounds* bounds, const shaftcull_query* query,
                                           uint32_t* overlap, uint64_t overlap_room, uint32_t* inside,
                                           uint64_t inside_room, shaftcull_kept_counts* counts) {
  return guarded([&] {
    shaftcull_kept_counts& out = given(counts, "counts");
    out = from_counts(shaftcull::list_classified(shaft_at(shafts, shaft), bounds_of(bounds, "bounds"),
                                                 as_span(overlap, overlap_room, "overlap"),
                                                 as_span(inside, inside_room, "inside"), query_of(query)));
  });
}

shaftcull_status shaftcull_lists_create(shaftcull_lists** lists) {
  return guarded([&] {
    shaftcull_lists*& out = given(lists, "lists");
    out = new shaftcull_lists{};
  });
}

void shaftcull_lists_free(shaftcull_lists* lists) { delete lists; }

shaftcull_status shaftcull_lists_describe(const shaftcull_lists* lists, shaftcull_lists_info* info) {
  return guarded([&] {
    const shaftcull::IndexLists& all = given(lists, "lists").lists;
    given(info, "info") = {all.size(), first_of(std::span(all.offsets)), first_of(std::span(all.indices))};
  });
}

shaftcull_status shaftcull_list_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                     const shaftcull_bounds* bounds, const shaftcull_query* query,
                                     shaftcull_lists* lists) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    shaftcull::list_many(asked.shafts, asked.bounds, given(lists, "lists").lists, asked.query);
  });
}

shaftcull_status shaftcull_list_classified_many(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                shaftcull_lists* overlap, shaftcull_lists* inside) {
  return guarded([&] {
    const Asked asked(shafts, first, count, bounds, "bounds", query);
    shaftcull::list_classified_many(asked.shafts, asked.bounds, given(overlap, "overlap").lists,
                                    given(inside, "inside").lists, asked.query);
  });
}

shaftcull_status shaftcull_list_occluders(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                          const shaftcull_bounds* solids, const shaftcull_query* query,
                                          shaftcull_lists* lists) {
  return guarded([&] {
    const Asked asked(shafts, first, count, solids, "solids", query);
    shaftcull::list_occluders_many(asked.shafts, asked.bounds, given(lists, "lists").lists, asked.query);
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

shaftcull_status shaftcull_entry_times(const shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_bounds* bounds,
                                       const uint32_t* indices, float* times, uint64_t count) {
  return guarded([&] {
    shaftcull::entry_times(shaft_at(shafts, shaft), bounds_of(bounds, "bounds"), as_span(indices, count, "indices"),
                           as_span(times, count, "times"));
  });
}

shaftcull_status shaftcull_classify_one(const shaftcull_shafts* shafts, uint64_t shaft, shaftcull_bound_kind kind,
                                        const void* bound, shaftcull_triangle_test test, shaftcull_answer* answer) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    shaftcull_answer& out = given(answer, "answer");
    const shaftcull::TriangleTest how = as_triangle_test(test);
    if (kind != SHAFTCULL_TRIANGLES && test != 0) refuse("test = 1 is for triangles; it is 0 for other bounds");
    (void)given(static_cast<const char*>(bound), "bound");
    switch (kind) {
      case SHAFTCULL_BOXES:
        out = static_cast<shaftcull_answer>(shaftcull::classify(asked, read<shaftcull::Box>(bound)));
        break;
      case SHAFTCULL_SPHERES:
        out = static_cast<shaftcull_answer>(shaftcull::classify(asked, read<shaftcull::Sphere>(bound)));
        break;
      case SHAFTCULL_TRIANGLES:
        out = classify_triangle(asked, read<shaftcull::Triangle>(bound), how);
        break;
      default:
        refuse_kind(kind);
    }
  });
}

shaftcull_status shaftcull_occluded_by(const shaftcull_shafts* shafts, uint64_t shaft, const float* corners,
                                       uint64_t count, uint32_t* occluded) {
  return guarded([&] {
    const CompiledShaft& asked = shaft_at(shafts, shaft);
    uint32_t& out = given(occluded, "occluded");
    if (count == 2) {
      (void)given(corners, "corners");
      const shaftcull::Box solid{as_vector(corners, "corners"), as_vector(corners + 3, "corners")};
      out = shaftcull::occluded(asked, solid) ? 1 : 0;
    } else {
      out = shaftcull::occluded(asked, as_vectors(corners, count, "corners")) ? 1 : 0;
    }
  });
}

}  // extern "C"
