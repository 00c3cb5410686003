// SPDX-License-Identifier: MIT
/// What the library throws, as Python's exceptions with the library's messages.

#include <cstddef>
#include <string>

#include "module.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::python {

namespace {

// Owned by the module, which is never unloaded. Translators are plain functions, so they find these here.
PyObject* bad_bound = nullptr;
PyObject* needs_refit = nullptr;

PyObject* new_exception(py::module_& module, const char* name, const char* text, PyObject* base) {
  const std::string full = std::string("shaftcull.") + name;
  PyObject* const type = PyErr_NewExceptionWithDoc(full.c_str(), text, base, nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.attr(name) = py::reinterpret_borrow<py::object>(type);
  return type;
}

void raise_bad_bound(const BadBound& error) {
  const py::object exception = py::reinterpret_borrow<py::object>(bad_bound)(error.what());
  exception.attr("index") = error.index();
  PyErr_SetObject(bad_bound, exception.ptr());
}

/// C++ calls an option `query.limit`; in Python it is a keyword of the same name.
std::string without_query(std::string message) {
  const std::string prefix = "query.";
  for (std::size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix, at)) {
    message.erase(at, prefix.size());
  }
  return message;
}

}  // namespace

void add_errors(py::module_& module) {
  bad_bound = new_exception(module, "BadBound", R"(
A bound, a point or a shaft of an array cannot be used: NaN, lo > hi, a negative radius, or what is not finite where it
must be. Attribute index: its position, from 0 on.)",
                            PyExc_ValueError);
  needs_refit = new_exception(module, "NeedsRefit", R"(
A tree was asked after update() with indices and before refit().)",
                              PyExc_RuntimeError);
  // pybind11 says what it takes. NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const BadBound& error) {
      raise_bad_bound(error);
    } catch (const InvalidArgument& error) {
      PyErr_SetString(PyExc_ValueError, without_query(error.what()).c_str());
    } catch (const NeedsRefit& error) {
      PyErr_SetString(needs_refit, error.what());
    }
  });
}

}  // namespace shaftcull::python
