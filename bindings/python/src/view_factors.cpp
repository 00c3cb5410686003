// SPDX-License-Identifier: MIT
#include "shaftcull/view_factors.hpp"

#include "bounds_in.hpp"
#include "module.hpp"

namespace shaftcull::python {

void add_view_factors(py::module_& module) {
  using py::arg;
  module.def(
      "view_factor",
      [](const py::object& from_corners, const py::object& to_corners) {
        return view_factor(vectors_in(from_corners, "from_corners").vectors,
                           vectors_in(to_corners, "to_corners").vectors);
      },
      arg("from_corners"), arg("to_corners"), R"(
The view factor from one flat convex polygon to another with nothing between them, from 0 to 1. What is
behind the other's plane does not count. The error is below 1e-8 of it, or 1e-11.

from_corners, to_corners: float32 (k, 3), 3 to 8 corners, counterclockwise as seen from the front. ValueError for
    another number of them, for one that is not finite, and if the first polygon has no area.)");
}

}  // namespace shaftcull::python
