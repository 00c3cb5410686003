// SPDX-License-Identifier: MIT
/// The parts of the module: one function each, which defines its classes and functions.
#pragma once

#include <pybind11/pybind11.h>

#include "shafts.hpp"

namespace shaftcull::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_shafts(py::module_& module);
void add_kinds(py::class_<Shafts>& shafts);
void add_hulls(py::module_& module);
void add_bounds(py::module_& module);
void add_box_streams(py::module_& module);
void add_box_trees(py::module_& module);
void add_sphere_streams(py::module_& module);
void add_sphere_trees(py::module_& module);
void add_triangles(py::module_& module);
void add_visibility(py::module_& module);
void add_solids(py::module_& module);
void add_rounding(py::module_& module);
void add_machine(py::module_& module);

}  // namespace shaftcull::python
