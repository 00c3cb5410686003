// SPDX-License-Identifier: MIT
/// Functions that make boxes: of points, of other solids.
#include "shaftcull/solids.hpp"

#include <vector>

#include "arrays.hpp"
#include "bounds_in.hpp"
#include "module.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

py::array points(const py::object& given, const py::object& rounding) {
  const py::array numbers = numbers_in(given, "points", rounding_in(rounding));
  const bool one = is_one_vector(numbers, "points");
  const Doubles from(numbers);
  std::vector<Box> boxes(static_cast<std::size_t>(from.size() / 3));
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    for (std::size_t axis = 0; axis != 3; ++axis) {
      boxes[i].lo[axis] = rounded_down(from.data()[3 * i + axis]);
      boxes[i].hi[axis] = rounded_up(from.data()[3 * i + axis]);
    }
  }
  return one ? array_of(boxes[0]) : rows_of(std::span<const Box>(boxes));
}

py::array merged(const py::object& given) {
  const BoxesInStreams boxes(given, "boxes", no_rounding);
  std::vector<Box> merged;
  {
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i != boxes.count(); ++i) merged.push_back(boxes.view()[i]);
    merged = merged_boxes(merged);
  }
  return rows_of(std::span<const Box>(merged));
}

}  // namespace

void add_boxes(py::module_& module) {
  using py::arg;
  module.def("points", &points, arg("points"), py::kw_only(), arg("rounding") = py::none(), R"(
Boxes that are points, for viewpoints and point lights: float32 (n, 6) for points (n, 3), or (6,) for (3,).

points: float32. rounding: 'outwards' also accepts float64; each box then contains its point. TypeError or
    ValueError for other arguments.)");
  module.def("merged_boxes", &merged, arg("boxes"), R"(
Larger solid boxes that cover exactly the space of the given boxes: pieces of a wall that share a face become
one box. float32 (m, 6); the boxes may overlap.

boxes: float32 (n, 6), or as for BoxStream. BadBound, with the index, for a box that is not finite or has
    lo > hi. Other threads of Python continue.)");
  module.def(
      "inscribed_box",
      [](const py::object& corners) { return array_of(inscribed_box(vectors_in(corners, "corners").vectors)); },
      arg("corners"), R"(
A large box inside the convex hull of points: float32 (6,). It lies in the hull exactly.

corners: float32 (k, 3), 4 to 32 points. ValueError for another number of points, or a point that is not
    finite.)");
}

}  // namespace shaftcull::python
