// SPDX-License-Identifier: MIT
/// Public calls that ask about the boxes or spheres of a view.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "calls/blocked_calls.hpp"
#include "calls/call_table.hpp"
#include "calls/tree_calls.hpp"
#include "forms.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

template <class Bound>
void add_view_calls(CallTable& table, const auto& stream, const std::vector<Bound>& bounds, BoundsTree<Bound>& tree) {
  const std::string of = std::is_same_v<Bound, Box> ? " of boxes" : " of spheres";
  const auto view = stream.view();
  const std::size_t words_a_row = words_for(view.count);
  for (const Form form : forms) {
    const std::string how = of + (form == Form::slab ? ", slab form" : ", planes form");
    table.add("cull" + how, true, [=, &table](AnswerWords& words) {
      std::vector<std::uint64_t> kept(words_a_row);
      for (const CompiledShaft& shaft : table.shafts) {
        cull(in_form(shaft, form), view, kept);
        note(words, kept);
      }
    });
    table.add("classify" + how, true, [=, &table](AnswerWords& words) {
      std::vector<std::uint64_t> kept(words_a_row);
      std::vector<std::uint64_t> inside(words_a_row);
      for (const CompiledShaft& shaft : table.shafts) {
        classify(in_form(shaft, form), view, kept, inside);
        note(words, kept);
        note(words, inside);
      }
    });
    table.add("count, any" + how, true, [=, &table](AnswerWords& words) {
      for (const CompiledShaft& shaft : table.shafts) {
        note(words, count(in_form(shaft, form), view));
        note(words, count_classified(in_form(shaft, form), view));
        note(words, any(in_form(shaft, form), view));
        note(words, count_at_most(in_form(shaft, form), view, 5));
      }
    });
    table.add("list" + how, true, [=, &table](AnswerWords& words) {
      std::vector<std::uint32_t> kept(view.count);
      for (const CompiledShaft& shaft : table.shafts) {
        note(words, std::span(kept).first(list(in_form(shaft, form), view, kept)));
        const std::span<std::uint32_t> few = std::span(kept).first(view.count / 8);
        note(words, few.first(list_at_most(in_form(shaft, form), view, few)));
      }
    });
    table.add("list_classified" + how, true, [=, &table](AnswerWords& words) {
      std::vector<std::uint32_t> overlap(view.count);
      std::vector<std::uint32_t> inside(view.count);
      for (const CompiledShaft& shaft : table.shafts) {
        const KeptCounts counts = list_classified(in_form(shaft, form), view, overlap, inside);
        note(words, std::span(overlap).first(counts.overlap));
        note(words, std::span(inside).first(counts.inside));
      }
    });
    table.add("first_contact" + how, true, [=, &table](AnswerWords& words) {
      std::vector<float> times(table.candidates.size());
      for (const CompiledShaft& shaft : table.shafts) {
        note(words, first_contact(in_form(shaft, form), view));
        entry_times(shaft, view, std::span<const std::uint32_t>(table.candidates), times);
        note(words, times);
      }
    });
    for (const std::size_t some : {std::size_t{3}, table.shafts.size()}) {
      const std::size_t count = std::min(some, table.shafts.size());
      const std::string many = how + ", " + std::to_string(count) + " shafts";
      const auto asked = [&table, count] { return std::span<const CompiledShaft>(table.shafts).last(count); };
      table.add("cull_many" + many, true, [=](AnswerWords& words) {
        std::vector<std::uint64_t> kept(count * words_a_row);
        cull_many(in_form(asked(), form), view, kept);
        note(words, kept);
      });
      table.add("classify_many" + many, true, [=](AnswerWords& words) {
        std::vector<std::uint64_t> kept(count * words_a_row);
        std::vector<std::uint64_t> inside(kept.size());
        classify_many(in_form(asked(), form), view, kept, inside);
        note(words, kept);
        note(words, inside);
      });
      table.add("count_many" + many, true, [=](AnswerWords& words) {
        std::vector<std::uint64_t> counts(count);
        count_many(in_form(asked(), form), view, counts);
        note(words, counts);
      });
      table.add("count_classified_many" + many, true, [=](AnswerWords& words) {
        std::vector<KeptCounts> counts(count);
        count_classified_many(in_form(asked(), form), view, counts);
        note(words, counts);
      });
      table.add("any_many" + many, true, [=](AnswerWords& words) {
        std::vector<std::uint64_t> bits(words_for(count));
        any_many(in_form(asked(), form), view, bits);
        note(words, bits);
      });
      table.add("first_contact_many" + many, true, [=](AnswerWords& words) {
        std::vector<FirstContact> contacts(count);
        first_contact_many(in_form(asked(), form), view, contacts);
        note(words, contacts);
      });
      table.add("count_at_most_many" + many, true, [=](AnswerWords& words) {
        std::vector<std::uint64_t> counts(count);
        count_at_most_many(in_form(asked(), form), view, 5, counts);
        note(words, counts);
      });
      table.add("list_at_most_many" + many, true, [=](AnswerWords& words) {
        std::vector<std::uint32_t> kept(5 * count);
        std::vector<std::uint64_t> counts(count);
        list_at_most_many(in_form(asked(), form), view, 5, kept, counts);
        note(words, kept);
        note(words, counts);
      });
      table.add("list_many" + many, true, [=](AnswerWords& words) {
        IndexLists lists;
        list_many(in_form(asked(), form), view, lists);
        note(words, lists.offsets);
        note(words, lists.indices);
      });
      table.add("list_classified_many" + many, true, [=](AnswerWords& words) {
        IndexLists overlap;
        IndexLists inside;
        list_classified_many(in_form(asked(), form), view, overlap, inside);
        note(words, overlap.indices);
        note(words, inside.indices);
      });
      table.add("for_each_tile" + many, true, [=](AnswerWords& words) {
        for_each_tile(in_form(asked(), form), view, [&](const TileAnswers& answers) { note(words, answers.kept); });
      });
      table.add("for_each_classified_tile" + many, true, [=](AnswerWords& words) {
        for_each_classified_tile(in_form(asked(), form), view,
                                 [&](const TileAnswers& answers) { note(words, answers.inside); });
      });
    }
  }
  table.add("contained" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint64_t> inside(words_a_row);
    for (const CompiledShaft& shaft : table.shafts) {
      contained(shaft, view, inside);
      note(words, inside);
    }
  });
  table.add("contained_many" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint64_t> inside(table.shafts.size() * words_a_row);
    contained_many(table.shafts, view, inside);
    note(words, inside);
  });
  table.add("classify one" + of, true, [=, &table, &bounds](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) note(words, static_cast<unsigned>(classify(shaft, bounds[1])));
  });
  table.add("cull one" + of, true, [=, &table, &bounds](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) note(words, cull(shaft, bounds[1]));
  });
  if constexpr (std::is_same_v<Bound, Box>) add_blocked_calls(table, view, bounds, tree);
  table.add("refine" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint32_t> kept(table.candidates.size());
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, std::span(kept).first(refine(shaft, view, std::span<const std::uint32_t>(table.candidates), kept)));
    }
  });
  table.add("refine_many" + of, true, [=, &table](AnswerWords& words) {
    IndexLists lists;
    refine_many(table.shafts, view, table.candidates, lists);
    note(words, lists.indices);
  });
  add_tree_calls<Bound>(table, of, view, bounds, tree);
}

}  // namespace shaftcull
