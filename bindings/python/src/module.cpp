// SPDX-License-Identifier: MIT
/// The module shaftcull._shaftcull, whose names the package shaftcull passes on.

#include "module.hpp"

PYBIND11_MODULE(_shaftcull, module) {
  using namespace shaftcull::python;
  module.attr("__name__") = "shaftcull";  // where its classes are found, and say that they are
  add_errors(module);
  add_hulls(module);
  add_shafts(module);
  add_bounds(module);
  add_box_streams(module);
  add_box_trees(module);
  add_sphere_streams(module);
  add_sphere_trees(module);
  add_triangles(module);
  add_visibility(module);
  add_solids(module);
  add_rounding(module);
  add_machine(module);
  module.attr("__name__") = "shaftcull._shaftcull";
}
