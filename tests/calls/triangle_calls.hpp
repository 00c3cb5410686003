// SPDX-License-Identifier: MIT
/// Public calls that make streams and trees of triangles, and that ask about one triangle.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

inline void add_triangle_calls(CallTable& table) {
  table.add("keeps of triangles", true, [&table](AnswerWords& words) {
    for (const CompiledShaft& shaft : table.shafts) {
      for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
        note(words, keeps(shaft, table.triangles[1], test));
      }
    }
  });
  table.add("TriangleStream, TriangleTree", false, [&table](AnswerWords& words) {
    TriangleStream stream(table.triangles);
    stream.update(3, std::span<const Triangle>(table.triangles).first(9));
    const TriangleTree tree(stream.view());
    note(words, tree.order());
    note(words, tree.box());
  });
  table.add("updates of a TriangleTree", false, [&table](AnswerWords& words) {
    TriangleTree tree(table.triangles);
    std::vector<Triangle> others(table.triangles.rbegin(), table.triangles.rend());
    tree.update(others);
    note(words, tree.box());
    const std::uint32_t some[] = {5, 2};
    tree.update(some, std::span<const Triangle>(table.triangles).first(2));
    tree.refit();
    note(words, tree.box());
    note(words, std::bit_cast<std::uint64_t>(tree.sah_ratio()));
    tree.rebuild();
    tree.reorder();
    note(words, tree.order());
    note(words, count(table.shafts[0], tree));
  });
}

}  // namespace shaftcull
