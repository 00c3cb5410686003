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
  const std::vector<Vec3> corners = {{-9, -9, -9}, {9, -9, -8}, {9, 9, 8.5F}, {-9, 9, 8}};
  table.add("blocked", true, [=, &table, &boxes, &tree](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.between) {
      note(words, blocked(shaft, boxes[1]));
      note(words, blocked(shaft, view));
      note(words, blocked(shaft, corners));
      note(words, blocked(shaft, tree, {.own = table.candidates}));
      note(words, blocked_by(shaft, view).value_or(view.count));
      note(words, blocked_by(shaft, tree).value_or(999));
    }
  });
  table.add("list_blocking", true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint32_t> listed(view.count);
    for (const CompiledShaft& shaft : table.between) {
      note(words, std::span(listed).first(list_blocking(shaft, view, listed)));
      note(words, std::span(listed).first(list_blocking(shaft, tree, listed, {.own = table.candidates})));
    }
  });
  table.add("list_blocking_many", true, [=, &table, &tree](AnswerWords& words) {
    IndexLists lists;
    list_blocking_many(table.between, view, lists);
    note(words, lists.offsets);
    note(words, lists.indices);
    list_blocking_many(table.between, tree, lists);
    note(words, lists.indices);
  });
  table.add("blocked_many", true, [=, &table, &tree](AnswerWords& words) {
    std::vector<std::uint64_t> bits(words_for(table.between.size()));
    blocked_many(table.between, view, bits);
    note(words, bits);
    blocked_many(table.between, tree, bits);
    note(words, bits);
  });
}

}  // namespace shaftcull
