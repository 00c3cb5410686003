// SPDX-License-Identifier: MIT
/// What trees of boxes and of spheres can do beyond questions.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "holders.hpp"
#include "interrupts.hpp"
#include "results.hpp"

namespace shaftcull::python {

/// Boxes and spheres of an argument, by the type of bound.
template <class Bound>
[[nodiscard]] auto bounds_in(const py::object& given, const std::string& name) {
  if constexpr (std::is_same_v<Bound, Box>) {
    return boxes_in(given, name);
  } else {
    return spheres_in(given, name);
  }
}

template <class Bound, class Class>
void add_tree(Class& to, const char* name, const std::string& plural) {
  using py::arg;
  using Tree = BoundsTree<Bound>;
  using Made = TreeOf<Bound>;
  const py::object none = py::none();
  to.def(py::init([plural](const py::object& given) {
           const auto bounds = bounds_in<Bound>(given, plural);
           begin_parallel();
           auto holder = std::make_unique<Made>();
           const py::gil_scoped_release release;
           std::visit([&holder](const auto& where) { holder->tree = Tree(where); }, bounds.where);
           return holder;
         }),
         arg(plural.c_str()))
      .def(
          "update",
          [plural](Made& self, const py::object& given, const py::object& indices) {
            const auto bounds = bounds_in<Bound>(given, plural);
            const bool some = !indices.is_none();
            const IndicesIn in = some ? indices_in(indices, "indices", self.size(), "bounds") : IndicesIn{};
            begin_parallel();
            const Changing changing(self.usage);
            const py::gil_scoped_release release;
            std::visit(
                [&](const auto& where) {
                  if (some) {
                    self.tree.update(in.indices, where);
                  } else {
                    self.tree.update(where);
                  }
                },
                bounds.where);
          },
          arg(plural.c_str()), arg("indices") = none, R"(
Gives bounds new values: all of them, in the order of their indices; or those at `indices`, integers (k,), after which
refit() is due before the next question.)")
      .def(
          "refit",
          [](Made& self) {
            begin_parallel();
            const Changing changing(self.usage);
            const py::gil_scoped_release release;
            self.tree.refit();
          },
          "Fits the nodes to bounds that were updated by indices.")
      .def_property_readonly(
          "needs_refit", [](const Made& self) { return self.tree.needs_refit(); },
          "Whether bounds were updated by indices since the last refit().")
      .def(
          "rebuild",
          [](Made& self) {
            begin_parallel();
            const Changing changing(self.usage);
            const py::gil_scoped_release release;
            self.tree.rebuild();
          },
          "Sorts the bounds again, as they are now. Indices stay; order changes. It pays when sah_ratio() is 2 or 3.")
      .def(
          "reorder",
          [](Made& self) {
            const Changing changing(self.usage);
            self.tree.reorder();
          },
          "Numbers the bounds again, by their places in the order of the tree.")
      .def(
          "sah_ratio",
          [](Made& self) {
            const Reading reading(self.usage);
            const py::gil_scoped_release release;
            return self.tree.sah_ratio();
          },
          "How much larger the smallest nodes have become since the tree was built: 1 at first.")
      .def_property_readonly(
          "order",
          [](Made& self) {
            const Reading reading(self.usage);
            return array_of(std::vector<std::uint32_t>(self.tree.order().begin(), self.tree.order().end()));
          },
          "uint32 (bounds,): the indices of the bounds in the order of the tree. A copy.")
      .def_property_readonly(
          "box",
          [](Made& self) {
            const Reading reading(self.usage);
            return array_of(self.tree.box());
          },
          "float32 (6,): the box around all bounds.")
      .def_property_readonly(
          "memory_bytes", [](const Made& self) { return self.tree.memory_bytes(); }, "Bytes that the tree holds.")
      .def("__repr__", [name, plural](const Made& self) {
        return std::string("<shaftcull.") + name + " of " + std::to_string(self.size()) + " " + plural + ">";
      });
}

}  // namespace shaftcull::python
