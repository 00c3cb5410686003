// SPDX-License-Identifier: MIT
/// What the library throws, as Python's exceptions with the library's messages.

#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

#include "module.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::python {

namespace {

/// A message of the library with Python's names of options.
std::string in_python(std::string message) {
  constexpr std::pair<const char*, const char*> names[] = {{"query.", ""}};
  for (const auto& [name, keyword] : names) {
    for (std::size_t at = message.find(name); at != std::string::npos; at = message.find(name, at)) {
      message.replace(at, std::strlen(name), keyword);
    }
  }
  return message;
}

}  // namespace

void add_errors(py::module_& module) {
  // Never deleted, as the module is never unloaded. Translators are plain functions, so they find these as statics.
  static auto& bad_bound = *new py::exception<BadBound>(module, "BadBound", PyExc_ValueError);
  static auto& needs_refit = *new py::exception<NeedsRefit>(module, "NeedsRefit", PyExc_RuntimeError);
  bad_bound.attr("__doc__") = R"(
A bound, point or shaft of an array cannot be used: NaN, lo > hi, a negative radius, or a number that is not
finite where it must be. The attribute `index` is its position, counted from 0.)";
  needs_refit.attr("__doc__") = "A tree was queried after update() with indices and before refit().";
  // pybind11 says what it takes. NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const BadBound& error) {
      const py::object raised = static_cast<const py::object&>(bad_bound)(error.what());
      raised.attr("index") = error.index();
      PyErr_SetObject(bad_bound.ptr(), raised.ptr());
    } catch (const InvalidArgument& error) {
      PyErr_SetString(PyExc_ValueError, in_python(error.what()).c_str());
    } catch (const NeedsRefit& error) {
      needs_refit(error.what());
    }
  });
}

}  // namespace shaftcull::python
