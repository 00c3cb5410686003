// SPDX-License-Identifier: MIT
/// Public calls that make trees of boxes or spheres, and that ask about them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

template <class Bound>
void add_tree_calls(CallTable& table, const std::string& of, const ViewOf<Bound>& view,
                    const std::vector<Bound>& bounds, BoundsTree<Bound>& tree) {
  const auto note_tree = [](AnswerWords& words, const BoundsTree<Bound>& built) {
    note(words, built.order());
    note(words, built.growth());
    for (std::size_t i = 0; i < built.size(); i += 9) note(words, built.leaves()[i]);
  };
  table.add("tree" + of, false, [=](AnswerWords& words) { note_tree(words, BoundsTree<Bound>(view)); });
  table.add("tree of records" + of, false, [=, &bounds](AnswerWords& words) {
    BoundsTree<Bound> built{std::span<const Bound>(bounds)};
    built.update(std::span<const Bound>(bounds));
    note_tree(words, built);
  });
  table.add("update, refit, rebuild, renumber of a tree" + of, false, [=, &table, &bounds, &tree](AnswerWords& words) {
    BoundsTree<Bound> moved(tree);
    moved.update(std::span<const std::uint32_t>(table.candidates), view.slice(0, table.candidates.size()));
    moved.refit();
    note_tree(words, moved);
    moved.update(std::span<const std::uint32_t>(table.candidates).first(2), std::span<const Bound>(bounds).first(2));
    moved.refit();
    moved.update(view);
    note_tree(words, moved);
    moved.rebuild();
    moved.renumber();
    note_tree(words, moved);
  });
  table.add("first_contact, first_contact_many in a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<FirstContact> contacts(table.shafts.size());
    std::vector<float> times(table.candidates.size());
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, first_contact(shaft, tree, {.own = table.candidates}));
      entry_times(shaft, tree, table.candidates, times);
      note(words, times);
    }
    first_contact_many(table.shafts, tree, contacts);
    note(words, contacts);
  });
  table.add("keep_layers" + of, true, [=, &table](AnswerWords& words) {
    std::vector<std::uint64_t> kept(words_for(view.count));
    std::vector<std::uint32_t> layers(view.count);
    for (std::size_t i = 0; i != layers.size(); ++i) layers[i] = 1U << i % 5;
    for (const CompiledShaft& shaft : table.shafts) {
      cull(shaft, view, kept);
      keep_layers(kept, layers, 9);
      note(words, kept);
    }
  });
  table.add("layers of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    BoundsTree<Bound> layered(tree);
    std::vector<std::uint32_t> layers(tree.size());
    for (std::size_t i = 0; i != layers.size(); ++i) layers[i] = 1U << i % 5;
    layered.set_layers(layers);
    layered.rebuild();
    layered.set_layers(std::span<const std::uint32_t>(table.candidates),
                       std::span(layers).first(table.candidates.size()));
    note(words, layered.layers());
    std::vector<std::uint32_t> kept(tree.size());
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, std::span(kept).first(list(shaft, layered, std::span(kept), {.only_layers = {3}})));
    }
  });
  table.add("count_at_most, list_at_most and both of many in a tree" + of, true,
            [=, &table, &tree](AnswerWords& words) {
              std::vector<std::uint32_t> kept(tree.size() / 8);
              for (const CompiledShaft& shaft : table.shafts) {
                note(words, count_at_most(shaft, tree, 5, {.own = table.candidates}));
                note(words, std::span(kept).first(list_at_most(shaft, tree, std::span(kept))));
              }
              std::vector<std::uint64_t> counts(table.shafts.size());
              count_at_most_many(table.shafts, tree, 5, counts);
              note(words, counts);
              kept.assign(5 * table.shafts.size(), 0);
              list_at_most_many(table.shafts, tree, 5, kept, counts);
              note(words, kept);
              note(words, counts);
            });
  table.add("box of a tree" + of, false, [=, &tree](AnswerWords& words) { note(words, tree.box()); });
  table.add("cull, contained, classify of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint64_t> kept(words_for(tree.size()));
    std::vector<std::uint64_t> inside(kept.size());
    for (const CompiledShaft& shaft : table.shafts) {
      cull(shaft, tree, kept, {.own = table.candidates});
      contained(shaft, tree, inside);
      note(words, kept);
      note(words, inside);
      classify(shaft, tree, kept, inside);
      note(words, kept);
      note(words, inside);
    }
  });
  table.add("cull_many, contained_many, classify_many of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint64_t> kept(table.shafts.size() * words_for(tree.size()));
    std::vector<std::uint64_t> inside(kept.size());
    cull_many(table.shafts, tree, kept);
    contained_many(table.shafts, tree, inside);
    note(words, kept);
    note(words, inside);
    classify_many(table.shafts, tree, kept, inside);
    note(words, kept);
    note(words, inside);
  });
  table.add("any, any_many in a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) note(words, any(shaft, tree));
    std::vector<std::uint64_t> found(words_for(table.shafts.size()));
    any_many(table.shafts, tree, found);
    note(words, found);
  });
  table.add("refine, refine_many of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint32_t> kept(table.candidates.size());
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, std::span(kept).first(refine(shaft, tree, table.candidates, kept)));
    }
    IndexLists lists;
    refine_many(table.shafts, BoundsTree<Bound>(tree), table.candidates, lists);  // looks up the leaves of indices
    note(words, lists.indices);
  });
  table.add("count in a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) note(words, count(shaft, tree, {.own = table.candidates}));
  });
  table.add("count_classified in a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) note(words, count_classified(shaft, tree));
  });
  table.add("list of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint32_t> kept(tree.size());
    std::vector<LeafRange> ranges(tree.size());
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, std::span(kept).first(list(shaft, tree, std::span(kept))));
      note(words, std::span(ranges).first(list(shaft, tree, std::span(ranges))));
    }
  });
  table.add("list_classified of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint32_t> overlap(tree.size());
    std::vector<std::uint32_t> inside(tree.size());
    for (const CompiledShaft& shaft : table.shafts) {
      const KeptCounts counts = list_classified(shaft, tree, std::span(overlap), std::span(inside));
      note(words, std::span(overlap).first(counts.overlap));
      note(words, std::span(inside).first(counts.inside));
    }
  });
  table.add("count_many in a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint64_t> counts(table.shafts.size());
    count_many(table.shafts, tree, counts);
    note(words, counts);
  });
  table.add("count_classified_many in a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    std::vector<KeptCounts> counts(table.shafts.size());
    count_classified_many(table.shafts, tree, counts);
    note(words, counts);
  });
  table.add("list_many of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    IndexLists overlap;
    IndexLists inside;
    list_many(table.shafts, tree, overlap);
    note(words, overlap.indices);
    list_classified_many(table.shafts, tree, overlap, inside);
    note(words, overlap.indices);
    note(words, inside.indices);
    LeafRangeLists ranges;
    list_many(table.shafts, tree, ranges);
    note(words, ranges.ranges);
  });
  table.add("for_each_kept of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    for_each_kept(table.shafts, tree, [&](const KeptRanges& answers) { note(words, answers.kept); });
  });
  table.add("for_each_classified of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    for_each_classified(table.shafts, tree, [&](const ClassifiedRanges& answers) {
      note(words, answers.overlap);
      note(words, answers.inside);
    });
  });
}

}  // namespace shaftcull
