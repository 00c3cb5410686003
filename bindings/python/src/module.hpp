// SPDX-License-Identifier: MIT
/// The parts of the module: one function each, which defines its classes and functions.
#pragma once

#include <pybind11/pybind11.h>

#include "shafts.hpp"

namespace shaftcull::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_shafts(py::module_& module);
void add_volumes(py::class_<Shafts>& shafts);
void add_hulls(py::module_& module);
void add_bounds(py::module_& module);
void add_holders(py::module_& module);
void add_dynamic(py::module_& module);
void add_boxes(py::module_& module);
void add_origin(py::module_& module);
void add_patches(py::module_& module);
void add_visibility(py::module_& module);
void add_view_factors(py::module_& module);
void add_light(py::module_& module);
void add_machine(py::module_& module);

}  // namespace shaftcull::python
