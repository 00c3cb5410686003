// SPDX-License-Identifier: MIT
/// Public calls that ask what blocks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

inline void add_occluded_calls(CallTable& table, const BoxView& view, const std::vector<Box>& boxes,
                               const BoxTree& tree) {
  const auto leave_out = [](const CallTable& of) {
    return Query{.exclude = of.candidates, .exclude_mask = of.mask, .layer_mask = {0b01011}};
  };
  const std::vector<Vec3> corners = {{-9, -9, -9}, {9, -9, -8}, {9, 9, 1e-39F}, {-9, 9, 1e-40F}};
  table.add("occluded", true, [=, &table, &boxes, &tree](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.between) {
      note(words, occluded(shaft, boxes[1]));
      note(words, occluded(shaft, view));
      note(words, occluded(shaft, corners));
      note(words, occluded(shaft, tree));
      note(words, find_occluder(shaft, view).value_or(999));
      note(words, find_occluder(shaft, tree).value_or(999));
      for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
        note(words, occluded(shaft, bounds, leave_out(table)));
        note(words, find_occluder(shaft, bounds, leave_out(table)).value_or(999));
      }
    }
  });
  table.add("list_occluders", true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint32_t> listed(view.count);
    for (const CompiledShaft& shaft : table.between) {
      for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
        note(words, std::span(listed).first(list_occluders(shaft, bounds, listed)));
        note(words, std::span(listed).first(list_occluders(shaft, bounds, listed, {.limit = 2})));
        note(words, std::span(listed).first(list_occluders(shaft, bounds, listed, leave_out(table))));
      }
    }
  });
  table.add("list_occluders_many", true, [=, &table, &tree](AnswerWords& words) {
    IndexLists lists;
    list_occluders_many(table.between, view, lists);
    note(words, lists.offsets);
    note(words, lists.indices);
    list_occluders_many(table.between, tree, lists);
    note(words, lists.indices);
    for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
      list_occluders_many(table.between, bounds, lists, leave_out(table));
      note(words, lists.indices);
    }
  });
  table.add("occluded_many", true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint64_t> bits(bit_words(table.between.size()));
    occluded_many(table.between, view, bits);
    note(words, bits);
    occluded_many(table.between, tree, bits);
    note(words, bits);
    for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
      occluded_many(table.between, bounds, bits, leave_out(table));
      note(words, bits);
    }
  });
}

}  // namespace shaftcull
