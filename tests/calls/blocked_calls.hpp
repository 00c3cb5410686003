// SPDX-License-Identifier: MIT
/// Public calls that ask what blocks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

inline void add_blocked_calls(CallTable& table, const BoxView& view, const std::vector<Box>& boxes,
                              const BoxTree& tree) {
  const auto leave_out = [](const CallTable& of) {
    return Query{.exclude = of.candidates, .exclude_mask = of.mask, .layer_mask = {0b01011}};
  };
  const std::vector<Vec3> corners = {{-9, -9, -9}, {9, -9, -8}, {9, 9, 8.5F}, {-9, 9, 8}};
  table.add("blocked", true, [=, &table, &boxes, &tree](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.between) {
      note(words, blocked(shaft, boxes[1]));
      note(words, blocked(shaft, view));
      note(words, blocked(shaft, corners));
      note(words, blocked(shaft, tree));
      note(words, blocked_by(shaft, view).value_or(999));
      note(words, blocked_by(shaft, tree).value_or(999));
      for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
        note(words, blocked(shaft, bounds, leave_out(table)));
        note(words, blocked_by(shaft, bounds, leave_out(table)).value_or(999));
      }
    }
  });
  table.add("list_blocking", true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint32_t> listed(view.count);
    for (const CompiledShaft& shaft : table.between) {
      for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
        note(words, std::span(listed).first(list_blocking(shaft, bounds, listed)));
        note(words, std::span(listed).first(list_blocking(shaft, bounds, listed, {.limit = 2})));
        note(words, std::span(listed).first(list_blocking(shaft, bounds, listed, leave_out(table))));
      }
    }
  });
  table.add("list_blocking_many", true, [=, &table, &tree](AnswerWords& words) {
    IndexLists lists;
    list_blocking_many(table.between, view, lists);
    note(words, lists.offsets);
    note(words, lists.indices);
    list_blocking_many(table.between, tree, lists);
    note(words, lists.indices);
    for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
      list_blocking_many(table.between, bounds, lists, leave_out(table));
      note(words, lists.indices);
    }
  });
  table.add("blocked_many", true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint64_t> bits(words_for(table.between.size()));
    blocked_many(table.between, view, bits);
    note(words, bits);
    blocked_many(table.between, tree, bits);
    note(words, bits);
    for (const Bounds& bounds : {Bounds(view, table.layers), Bounds(tree)}) {
      blocked_many(table.between, bounds, bits, leave_out(table));
      note(words, bits);
    }
  });
}

}  // namespace shaftcull
