// SPDX-License-Identifier: MIT
/// Public calls that make trees of boxes or spheres, and change them.
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
    note(words, built.sah_ratio());
    for (std::size_t i = 0; i < built.size(); i += 9) note(words, built.leaves()[i]);
  };
  table.add("tree" + of, false, [=](AnswerWords& words) { note_tree(words, BoundsTree<Bound>(view)); });
  table.add("tree of records" + of, false, [=, &bounds](AnswerWords& words) {
    BoundsTree<Bound> built{std::span<const Bound>(bounds)};
    built.update(std::span<const Bound>(bounds));
    note_tree(words, built);
  });
  table.add("update, refit, rebuild, reorder of a tree" + of, false, [=, &table, &bounds, &tree](AnswerWords& words) {
    BoundsTree<Bound> moved(tree);
    moved.update(std::span<const std::uint32_t>(table.candidates), view.slice(0, table.candidates.size()));
    moved.refit();
    note_tree(words, moved);
    moved.update(std::span<const std::uint32_t>(table.candidates).first(2), std::span<const Bound>(bounds).first(2));
    moved.refit();
    moved.update(view);
    note_tree(words, moved);
    moved.rebuild();
    moved.reorder();
    note_tree(words, moved);
  });
  table.add("layers of a tree" + of, true, [=, &table, &tree](AnswerWords& words) {
    BoundsTree<Bound> layered(tree);
    layered.set_layers(table.layers);
    layered.rebuild();
    layered.set_layers(table.candidates, std::span(table.layers).first(table.candidates.size()));
    note(words, layered.layers());
    std::vector<std::uint32_t> kept;
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, list(shaft, layered, kept, {.layer_mask = {3}}));
      note(words, kept);
    }
  });
  table.add("changes and commits of a dynamic tree" + of, true, [=, &table, &bounds](AnswerWords& words) {
    DynamicTree<Bound> tree_of_ids;
    std::vector<BoundId> ids(bounds.size());
    tree_of_ids.insert(bounds, ids, table.layers);
    tree_of_ids.commit();
    const TreeSnapshot<Bound> before = tree_of_ids.snapshot();
    const std::size_t few = bounds.size() / 9;
    tree_of_ids.erase(std::span<const BoundId>(ids).first(few));
    tree_of_ids.move(std::span<const BoundId>(ids).subspan(few, few), std::span<const Bound>(bounds).first(few));
    tree_of_ids.set_layers(ids.back(), 1);
    tree_of_ids.insert(bounds.front(), 2);
    tree_of_ids.commit();
    note(words, tree_of_ids.committed().box());
    note(words, tree_of_ids.upkeep().sah_ratio);
    std::vector<std::uint32_t> kept;
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, list(shaft, tree_of_ids, kept, {.layer_mask = {3}}));
      note(words, kept);
      note(words, count(shaft, before));
    }
  });
  table.add("box of a tree" + of, false, [=, &tree](AnswerWords& words) { note(words, tree.box()); });
  table.add("list of a tree that looks up leaves" + of, true, [=, &table, &tree](AnswerWords& words) {
    IndexLists lists;
    list_many(table.shafts, BoundsTree<Bound>(tree), lists, {.only = table.candidates});
    note(words, lists.indices);
  });
}

}  // namespace shaftcull
