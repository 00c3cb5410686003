// SPDX-License-Identifier: MIT
/// The module shaftcull._shaftcull, whose names the package shaftcull passes on.

#include "module.hpp"

PYBIND11_MODULE(_shaftcull, module) {
  using namespace shaftcull::python;
  module.attr("__name__") = "shaftcull";  // the module that classes name as theirs
  add_errors(module);
  add_hulls(module);
  add_shafts(module);
  add_bounds(module);
  add_holders(module);
  add_dynamic(module);
  add_boxes(module);
  add_origin(module);
  add_patches(module);
  add_visibility(module);
  add_view_factors(module);
  add_light(module);
  add_machine(module);
  module.attr("__name__") = "shaftcull._shaftcull";
}
