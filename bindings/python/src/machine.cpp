// SPDX-License-Identifier: MIT
/// Instruction sets, threads, version.

#include "module.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull::python {

void add_machine(py::module_& module) {
  module.attr("__version__") = SHAFTCULL_VERSION_STRING;
  module.def(
      "available_isas",
      [] {
        py::list names;
        for (const Isa isa : available_isas()) names.append(std::string(name(isa)));
        return names;
      },
      "Names of the instruction sets that this machine can run, slowest first.");
  module.def(
      "active_isa", [] { return std::string(name(active_isa())); },
      "The name of the instruction set in use. Answers do not depend on it.");
  module.def(
      "select_isa",
      [](const std::string& isa) {
        const auto known = isa_from_name(isa);
        if (!known) throw py::value_error("there is no instruction set '" + isa + "'; see available_isas()");
        select_isa(*known);
      },
      py::arg("isa"),
      "Makes all threads use an instruction set from now on: one of available_isas(). ValueError for others.");
  module.def("concurrency", &concurrency, "The number of threads that a call for many shafts uses.");
}

}  // namespace shaftcull::python
