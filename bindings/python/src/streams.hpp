// SPDX-License-Identifier: MIT
/// What views and streams can do beyond questions.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "arrays.hpp"
#include "holders.hpp"

namespace shaftcull::python {

/// A stream, which owns its bounds: in(given) reads what it is made of and updated with.
template <class Stream, class Class, class In>
void add_stream(Class& to, const char* name, const std::string& plural, const In& in) {
  using py::arg;
  using Made = Streamed<Stream>;
  to.def(py::init([plural, in](const py::object& given) {
           const auto bounds = in(given, plural);
           const py::gil_scoped_release release;
           return std::visit([](const auto& where) { return std::make_unique<Made>(Stream(where)); }, bounds.where);
         }),
         arg(plural.c_str()))
      .def(
          "update",
          [plural, in](Made& self, const py::object& given, const py::object& first) {
            const auto bounds = in(given, plural);
            const std::size_t from = number_in(first, "first").value_or(0);
            const Changing changing(self.usage);
            const py::gil_scoped_release release;
            std::visit([&self, from](const auto& where) { self.stream.update(from, where); }, bounds.where);
          },
          arg(plural.c_str()), arg("first") = 0, "Replaces bounds from `first` on, as many as are given.")
      .def_property_readonly(
          "memory_bytes", [](const Made& self) { return self.stream.memory_bytes(); }, "Bytes that the stream holds.")
      .def("__repr__", [name, plural](const Made& self) {
        return std::string("<shaftcull.") + name + " of " + std::to_string(self.size()) + " " + plural + ">";
      });
}

/// A view of the caller's arrays: in(given) reads them, and must find a View there.
template <class View, class Class, class In>
void add_view(Class& to, const char* name, const std::string& plural, const std::string& columns, const In& in) {
  using py::arg;
  using Made = Viewed<View>;
  to.def(py::init([name, plural, columns, in](const py::object& given) {
           auto bounds = in(given, plural);
           auto holder = std::make_unique<Made>();
           if (bounds.count == 0) return holder;
           const View* const view = std::get_if<View>(&bounds.where);
           if (view == nullptr || bounds.copied) {
             throw py::value_error(plural + " do not lie in columns: a " + name +
                                   " copies nothing, so each coordinate must lie in memory of its own, entry beside "
                                   "entry. Pass " +
                                   columns + ", or make a stream");
           }
           holder->view = *view;
           holder->kept = std::move(bounds.kept);
           return holder;
         }),
         arg(plural.c_str()))
      .def("__repr__", [name, plural](const Made& self) {
        return std::string("<shaftcull.") + name + " of " + std::to_string(self.size()) + " " + plural + ">";
      });
}

}  // namespace shaftcull::python
