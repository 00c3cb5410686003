// SPDX-License-Identifier: MIT
/// Public calls that ask about bounds, of any kind and whatever holds them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calls/call_table.hpp"
#include "forms.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// Bounds that calls ask about, and in which way.
struct AskedBounds {
  Bounds bounds;
  std::string name;
  std::optional<Form> form{};  ///< of the shafts; as they are if not given
  bool have_times = true;      ///< whether first contact is asked for
  bool have_layers = true;
  TriangleTest triangle_test = TriangleTest::exact;

  [[nodiscard]] std::size_t words() const { return bit_words(bounds.size()); }
  [[nodiscard]] CompiledShaft shaft(const CompiledShaft& given) const { return form ? in_form(given, *form) : given; }
  [[nodiscard]] std::vector<CompiledShaft> shafts(std::span<const CompiledShaft> given) const {
    return form ? in_form(given, *form) : std::vector<CompiledShaft>(given.begin(), given.end());
  }
};

/// A query with all options that leave bounds out.
inline Query query_that_leaves_out(const CallTable& table, const AskedBounds& asked) {
  Query query{.exclude = std::span(table.candidates).first(8),
              .exclude_mask = table.mask,
              .triangle_test = asked.triangle_test};
  if (asked.have_layers) query.layer_mask = {0b01011};
  return query;
}

inline void add_calls_for_one_shaft(CallTable& table, const AskedBounds& asked) {
  const std::string& of = asked.name;
  const Query plain{.triangle_test = asked.triangle_test};
  table.add("cull" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint64_t> kept(asked.words());
    for (const CompiledShaft& shaft : table.shafts) {
      cull(asked.shaft(shaft), asked.bounds, kept, plain);
      note(words, kept);
    }
  });
  table.add("classify" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint64_t> kept(asked.words());
    std::vector<std::uint64_t> inside(asked.words());
    for (const CompiledShaft& shaft : table.shafts) {
      classify(asked.shaft(shaft), asked.bounds, kept, inside, plain);
      note(words, kept);
      note(words, inside);
    }
  });
  table.add("classify of bounds inside alone" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint64_t> inside(asked.words());
    for (const CompiledShaft& shaft : table.shafts) {
      classify(asked.shaft(shaft), asked.bounds, {}, inside, plain);
      note(words, inside);
    }
  });
  table.add("count, count_classified, any" + of, true, [=, &table](AnswerWords& words) {
    Query few = plain;
    few.limit = 5;
    for (const CompiledShaft& given : table.shafts) {
      const CompiledShaft shaft = asked.shaft(given);
      note(words, count(shaft, asked.bounds, plain));
      note(words, count(shaft, asked.bounds, few));
      note(words, count_classified(shaft, asked.bounds, plain));
      note(words, any(shaft, asked.bounds, plain));
    }
  });
  table.add("list" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint32_t> kept(asked.bounds.size());
    const std::span<std::uint32_t> room(kept);
    Query few = plain;
    few.limit = kept.size() / 8;
    for (const CompiledShaft& given : table.shafts) {
      const CompiledShaft shaft = asked.shaft(given);
      note(words, room.first(list(shaft, asked.bounds, room, plain)));
      note(words, room.first(list(shaft, asked.bounds, room, few)));
    }
  });
  table.add("list into a vector" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint32_t> kept;
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, list(asked.shaft(shaft), asked.bounds, kept, plain));
      note(words, kept);
    }
  });
  table.add("list_classified" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint32_t> overlap(asked.bounds.size());
    std::vector<std::uint32_t> inside(asked.bounds.size());
    for (const CompiledShaft& shaft : table.shafts) {
      const KeptCounts counts = list_classified(asked.shaft(shaft), asked.bounds, overlap, inside, plain);
      note(words, std::span(overlap).first(counts.overlap));
      note(words, std::span(inside).first(counts.inside));
    }
  });
  if (!asked.have_times) return;
  table.add("first_contact, entry_times" + of, true, [=, &table](AnswerWords& words) {
    std::vector<float> times(table.candidates.size());
    for (const CompiledShaft& given : table.shafts) {
      const CompiledShaft shaft = asked.shaft(given);
      note(words, first_contact(shaft, asked.bounds));
      entry_times(shaft, asked.bounds, table.candidates, times);
      note(words, times);
    }
  });
}

/// For the last `count` shafts of the table.
inline void add_calls_for_many_shafts(CallTable& table, const AskedBounds& asked, std::size_t count) {
  const std::string of = asked.name + ", " + std::to_string(count) + " shafts";
  const Query plain{.triangle_test = asked.triangle_test};
  const auto shafts = [=, &table] { return asked.shafts(std::span(table.shafts).last(count)); };
  table.add("cull_many" + of, true, [=](AnswerWords& words) {
    std::vector<std::uint64_t> kept(count * asked.words());
    cull_many(shafts(), asked.bounds, kept, plain);
    note(words, kept);
  });
  table.add("classify_many" + of, true, [=](AnswerWords& words) {
    std::vector<std::uint64_t> kept(count * asked.words());
    std::vector<std::uint64_t> inside(kept.size());
    classify_many(shafts(), asked.bounds, kept, inside, plain);
    note(words, kept);
    note(words, inside);
  });
  table.add("classify_many of bounds inside alone" + of, true, [=](AnswerWords& words) {
    std::vector<std::uint64_t> inside(count * asked.words());
    classify_many(shafts(), asked.bounds, {}, inside, plain);
    note(words, inside);
  });
  table.add("count_many" + of, true, [=](AnswerWords& words) {
    std::vector<std::uint64_t> counts(count);
    count_many(shafts(), asked.bounds, counts, plain);
    note(words, counts);
    Query few = plain;
    few.limit = 5;
    count_many(shafts(), asked.bounds, counts, few);
    note(words, counts);
  });
  table.add("count_classified_many" + of, true, [=](AnswerWords& words) {
    std::vector<KeptCounts> counts(count);
    count_classified_many(shafts(), asked.bounds, counts, plain);
    note(words, counts);
  });
  table.add("any_many" + of, true, [=](AnswerWords& words) {
    std::vector<std::uint64_t> bits(bit_words(count));
    any_many(shafts(), asked.bounds, bits, plain);
    note(words, bits);
  });
  table.add("list_many" + of, true, [=](AnswerWords& words) {
    IndexLists lists;
    list_many(shafts(), asked.bounds, lists, plain);
    note(words, lists.offsets);
    note(words, lists.indices);
    Query few = plain;
    few.limit = 5;
    list_many(shafts(), asked.bounds, lists, few);
    note(words, lists.offsets);
    note(words, lists.indices);
  });
  table.add("list_classified_many" + of, true, [=](AnswerWords& words) {
    IndexLists overlap;
    IndexLists inside;
    list_classified_many(shafts(), asked.bounds, overlap, inside, plain);
    note(words, overlap.indices);
    note(words, inside.indices);
  });
  if (!asked.have_times) return;
  table.add("first_contact_many" + of, true, [=](AnswerWords& words) {
    std::vector<FirstContact> contacts(count);
    first_contact_many(shafts(), asked.bounds, contacts);
    note(words, contacts);
  });
}

/// Calls with options.
inline void add_calls_with_options(CallTable& table, const AskedBounds& asked) {
  const std::string of = asked.name;
  table.add("calls that leave bounds out" + of, true, [=, &table](AnswerWords& words) {
    const Query query = query_that_leaves_out(table, asked);
    std::vector<std::uint64_t> kept(asked.words());
    std::vector<std::uint64_t> inside(asked.words());
    std::vector<std::uint32_t> listed(asked.bounds.size());
    const std::span<std::uint32_t> room(listed);
    for (const CompiledShaft& given : table.shafts) {
      const CompiledShaft shaft = asked.shaft(given);
      classify(shaft, asked.bounds, kept, inside, query);
      note(words, kept);
      note(words, inside);
      note(words, count(shaft, asked.bounds, query));
      note(words, any(shaft, asked.bounds, query));
      note(words, room.first(list(shaft, asked.bounds, room, query)));
      if (asked.have_times) note(words, first_contact(shaft, asked.bounds, query));
    }
  });
  table.add("calls for many shafts that leave bounds out" + of, true, [=, &table](AnswerWords& words) {
    Query query = query_that_leaves_out(table, asked);
    query.exclude_each = table.of_each;
    const std::vector<CompiledShaft> shafts = asked.shafts(table.shafts);
    std::vector<std::uint64_t> kept(shafts.size() * asked.words());
    cull_many(shafts, asked.bounds, kept, query);
    note(words, kept);
    std::vector<KeptCounts> counts(shafts.size());
    count_classified_many(shafts, asked.bounds, counts, query);
    note(words, counts);
    std::vector<std::uint64_t> bits(bit_words(shafts.size()));
    any_many(shafts, asked.bounds, bits, query);
    note(words, bits);
    IndexLists lists;
    list_many(shafts, asked.bounds, lists, query);
    note(words, lists.indices);
    if (!asked.have_times) return;
    std::vector<FirstContact> contacts(shafts.size());
    first_contact_many(shafts, asked.bounds, contacts, query);
    note(words, contacts);
  });
  table.add("calls about candidates" + of, true, [=, &table](AnswerWords& words) {
    const Query query{.only = table.candidates, .triangle_test = asked.triangle_test};
    std::vector<std::uint64_t> kept(asked.words());
    std::vector<std::uint64_t> inside(asked.words());
    std::vector<std::uint32_t> listed(table.candidates.size());
    const std::span<std::uint32_t> room(listed);
    for (const CompiledShaft& given : table.shafts) {
      const CompiledShaft shaft = asked.shaft(given);
      classify(shaft, asked.bounds, kept, inside, query);
      note(words, kept);
      note(words, inside);
      note(words, count_classified(shaft, asked.bounds, query));
      note(words, any(shaft, asked.bounds, query));
      note(words, room.first(list(shaft, asked.bounds, room, query)));
      if (asked.have_times) note(words, first_contact(shaft, asked.bounds, query));
    }
  });
  table.add("calls for many shafts about candidates" + of, true, [=, &table](AnswerWords& words) {
    const Query query{.only = table.candidates, .triangle_test = asked.triangle_test};
    const std::vector<CompiledShaft> shafts = asked.shafts(table.shafts);
    std::vector<std::uint64_t> kept(shafts.size() * asked.words());
    std::vector<std::uint64_t> inside(kept.size());
    classify_many(shafts, asked.bounds, kept, inside, query);
    note(words, kept);
    note(words, inside);
    std::vector<std::uint64_t> counts(shafts.size());
    count_many(shafts, asked.bounds, counts, query);
    note(words, counts);
    IndexLists lists;
    list_many(shafts, asked.bounds, lists, query);
    note(words, lists.indices);
    if (!asked.have_times) return;
    std::vector<FirstContact> contacts(shafts.size());
    first_contact_many(shafts, asked.bounds, contacts, query);
    note(words, contacts);
  });
}

/// Every verb, for one shaft, three and all, with options and without.
inline void add_query_calls(CallTable& table, const AskedBounds& asked) {
  add_calls_for_one_shaft(table, asked);
  for (const std::size_t count : {std::size_t{3}, table.shafts.size()}) {
    add_calls_for_many_shafts(table, asked, std::min(count, table.shafts.size()));
  }
  add_calls_with_options(table, asked);
}

/// Of a view, a stream's, whose layers are the table's. Shafts are asked in both forms.
template <class View>
void add_view_calls(CallTable& table, const std::string& of, const View& view) {
  for (const Form form : forms) {
    add_query_calls(table, {.bounds = Bounds(view, table.layers),
                            .name = of + (form == Form::slab ? ", slab form" : ", planes form"),
                            .form = form});
  }
}

/// Of triangles, by both tests.
inline void add_triangle_query_calls(CallTable& table, const std::string& of, const Bounds& bounds, bool have_layers) {
  for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
    add_query_calls(table, {.bounds = bounds,
                            .name = of + (test == TriangleTest::exact ? ", exactly" : ", by vertices"),
                            .have_times = false,
                            .have_layers = have_layers,
                            .triangle_test = test});
  }
}

/// Of one bound.
template <class Bound>
void add_calls_about_one(CallTable& table, const std::string& of, const std::vector<Bound>& bounds) {
  table.add("keeps" + of, true, [&table, &bounds](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) note(words, keeps(shaft, bounds[1]));
  });
  table.add("classify one" + of, true, [&table, &bounds](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) note(words, static_cast<unsigned>(classify(shaft, bounds[1])));
  });
}

}  // namespace shaftcull
