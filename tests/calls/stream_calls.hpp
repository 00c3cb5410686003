// SPDX-License-Identifier: MIT
/// Public calls that make and update streams of boxes and spheres.
#pragma once

#include <cstddef>
#include <span>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

inline void add_stream_calls(CallTable& table) {
  table.add("BoxStream", false, [&table](AnswerWords& words) {
    BoxStream stream(table.boxes);
    stream.update(3, std::span<const Box>(table.boxes).first(9));
    for (std::size_t i = 0; i < stream.size(); i += 5) note(words, stream[i]);
    note(words, BoxStream(stream)[2]);
  });
  for (int i = 0; i != 70; ++i) {
    for (const float x : {0.1F, 0.3F, 1e-40F, 0.7F, 1e-30F, 3.3F}) table.centres.push_back(x * static_cast<float>(i));
  }
  table.add("BoxStream and BoxTree of centres", false, [&table](AnswerWords& words) {
    const BoxStream stream(StridedCentreExtents{table.centres.data(), table.centres.data() + 3, 6 * sizeof(float), 70});
    for (std::size_t i = 0; i != stream.size(); ++i) note(words, stream[i]);
    BoxTree tree(StridedCentreExtents{table.centres.data(), table.centres.data() + 3, 6 * sizeof(float), 70});
    tree.update(StridedCentreExtents{table.centres.data(), table.centres.data() + 3, 6 * sizeof(float), 70});
    for (std::size_t i = 0; i != tree.size(); ++i) note(words, tree.leaves()[i]);
  });
  table.add("SphereStream", false, [&table](AnswerWords& words) {
    SphereStream stream(table.spheres);
    stream.update(3, std::span<const Sphere>(table.spheres).first(9));
    for (std::size_t i = 0; i < stream.size(); i += 5) note(words, stream[i]);
  });
}

}  // namespace shaftcull
