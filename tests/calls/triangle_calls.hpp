// SPDX-License-Identifier: MIT
/// Public calls that ask about triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// Of a view or of a tree that the caller keeps.
template <class Triangles>
void add_triangle_calls(CallTable& table, const std::string& of, const Triangles& triangles) {
  const std::size_t count = table.triangles.size();
  const auto ask = [&](const std::string& name, auto call) {
    for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
      const std::string what = name + of + (test == TriangleTest::exact ? ", exactly" : ", by vertices");
      if constexpr (std::is_same_v<Triangles, TriangleView>) {
        table.add(what, true, [=, &table](AnswerWords& words) { call(words, table.triangle_stream.view(), test); });
      } else {
        table.add(what, true, [=, &triangles](AnswerWords& words) { call(words, triangles, test); });
      }
    }
  };
  ask("cull of triangles", [=, &table](AnswerWords& words, const Triangles& all, TriangleTest test) {
    std::vector<std::uint64_t> kept(words_for(count));
    for (const CompiledShaft& shaft : table.shafts) {
      cull(shaft, all, kept, test);
      note(words, kept);
      note(words, cull(shaft, table.triangles[1], test));
    }
  });
  ask("count, any, list of triangles", [=, &table](AnswerWords& words, const Triangles& all, TriangleTest test) {
    std::vector<std::uint32_t> kept(count);
    for (const CompiledShaft& shaft : table.shafts) {
      note(words, shaftcull::count(shaft, all, test));
      note(words, any(shaft, all, test));
      note(words, std::span(kept).first(list(shaft, all, kept, test)));
    }
  });
  ask("cull_many, count_many, any_many of triangles",
      [=, &table](AnswerWords& words, const Triangles& all, TriangleTest test) {
        std::vector<std::uint64_t> kept(table.shafts.size() * words_for(count));
        cull_many(table.shafts, all, kept, test);
        note(words, kept);
        std::vector<std::uint64_t> counts(table.shafts.size());
        count_many(table.shafts, all, counts, test);
        note(words, counts);
        std::vector<std::uint64_t> found(words_for(table.shafts.size()));
        any_many(table.shafts, all, found, test);
        note(words, found);
      });
  ask("list_many of triangles", [=, &table](AnswerWords& words, const Triangles& all, TriangleTest test) {
    IndexLists lists;
    list_many(table.shafts, all, lists, test);
    note(words, lists.offsets);
    note(words, lists.indices);
  });
  table.add("TriangleStream, TriangleTree" + of, false, [&table](AnswerWords& words) {
    TriangleStream stream(table.triangles);
    stream.update(3, std::span<const Triangle>(table.triangles).first(9));
    const TriangleTree tree(stream.view());
    note(words, tree.order());
    note(words, tree.box());
  });
}

}  // namespace shaftcull
