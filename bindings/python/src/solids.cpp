// SPDX-License-Identifier: MIT
/// Larger solid boxes, and boxes inside turned ones.
#include "shaftcull/solids.hpp"

#include <vector>

#include "arrays.hpp"
#include "module.hpp"
#include "patches.hpp"
#include "results.hpp"

namespace shaftcull::python {

void add_solids(py::module_& module) {
  using py::arg;
  module.def(
      "merged_boxes",
      [](const py::object& boxes) {
        const BoxesInStreams in(boxes, "boxes");
        std::vector<Box> merged;
        {
          const py::gil_scoped_release release;
          std::vector<Box> all(in.view().count);
          for (std::size_t i = 0; i != all.size(); ++i) all[i] = in.view()[i];
          merged = merged_boxes(all);
        }
        py::array_t<float> out(std::vector<py::ssize_t>{static_cast<py::ssize_t>(merged.size()), 6});
        float* to = out.mutable_data();
        for (const Box& box : merged) {
          for (const float coordinate : box.lo) *to++ = coordinate;
          for (const float coordinate : box.hi) *to++ = coordinate;
        }
        return out;
      },
      arg("boxes"), R"(
Larger solid boxes that cover nothing but what the given ones cover: pieces of a wall that share a face become one.
float32 (m, 6); they may overlap.)");
  module.def(
      "inscribed_box",
      [](const py::object& corners) {
        const VectorsIn in = vectors_in(corners, "corners");
        return array_of(inscribed_box(in.vectors));
      },
      arg("corners"), R"(
A large box inside the convex hull of 4 to 32 points (k, 3): float32 (6,). No coordinate is rounded outwards.)");
}

}  // namespace shaftcull::python
