// SPDX-License-Identifier: MIT
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "interrupts.hpp"
#include "module.hpp"
#include "results.hpp"
#include "streams.hpp"

namespace shaftcull::python {

void add_triangles(py::module_& module) {
  using py::arg;
  using Tree = TriangleTreeHolder;
  using Stream = Streamed<TriangleStream>;
  const py::object none = py::none();

  py::class_<Viewed<TriangleView>, HolderOf<Triangle>> view(module, "TriangleView", R"(
Triangles in an array of the caller's, which is kept and never copied.

triangles: float32 whose columns are contiguous: (n, 9) in Fortran order, the transpose of (9, n), or such (n, 3, 3).

Values are not checked, and may change between questions.)");
  add_view<TriangleView>(
      view, "TriangleView", "triangles", "a transpose of (9, n) or numpy.asfortranarray(triangles)",
      [](const py::object& given, const std::string& name) { return triangles_in(given, py::none(), name); });

  py::class_<Stream, HolderOf<Triangle>>(module, "TriangleStream", R"(
A copy of triangles, checked, in separate aligned streams: 36 bytes per triangle.

triangles: float32 (n, 3, 3): vertices, then x, y, z; or (n, 9); or with faces: vertices (v, 3).
faces: integers (f, 3). BadBound, with the index of the triangle, for what is not finite.)")
      .def(py::init([](const py::object& given, const py::object& faces) {
             const TrianglesIn in = triangles_in(given, faces, "triangles");
             const py::gil_scoped_release release;
             return std::visit([](const auto& where) { return std::make_unique<Stream>(TriangleStream(where)); },
                               in.where);
           }),
           arg("triangles"), arg("faces") = none)
      .def(
          "update",
          [](Stream& self, const py::object& given, const py::object& first, const py::object& faces) {
            const TrianglesIn in = triangles_in(given, faces, "triangles");
            const std::size_t from = number_in(first, "first").value_or(0);
            const Changing changing(self.usage);
            const py::gil_scoped_release release;
            std::visit([&self, from](const auto& where) { self.stream.update(from, where); }, in.where);
          },
          arg("triangles"), arg("first") = 0, arg("faces") = none,
          "Replaces triangles from `first` on, as many as are given.")
      .def_property_readonly(
          "memory_bytes", [](const Stream& self) { return self.stream.memory_bytes(); }, "Bytes that the stream holds.")
      .def("__repr__", [](const Stream& self) {
        return "<shaftcull.TriangleStream of " + std::to_string(self.size()) + " triangles>";
      });

  py::class_<Tree, HolderOf<Triangle>> tree(module, "TriangleTree", R"(
A tree over a copy of triangles, sorted by space. Answers equal those of a TriangleStream. It is not updated, and has
no layers.

triangles: float32 (n, 3, 3) or (n, 9); or with faces: vertices (v, 3). faces: integers (f, 3).)");
  tree.def(py::init([](const py::object& given, const py::object& faces) {
             const TrianglesIn in = triangles_in(given, faces, "triangles");
             begin_parallel();
             auto holder = std::make_unique<Tree>();
             const py::gil_scoped_release release;
             std::visit([&holder](const auto& where) { holder->tree = TriangleTree(where); }, in.where);
             return holder;
           }),
           arg("triangles"), arg("faces") = none)
      .def_property_readonly(
          "order",
          [](const Tree& self) {
            return array_of(std::vector<std::uint32_t>(self.tree.order().begin(), self.tree.order().end()));
          },
          "uint32 (n,): the indices of the triangles in the order of the tree. A copy.")
      .def_property_readonly(
          "box", [](const Tree& self) { return array_of(self.tree.box()); },
          "float32 (6,): the box around all triangles.")
      .def_property_readonly(
          "memory_bytes", [](const Tree& self) { return self.tree.memory_bytes(); }, "Bytes that the tree holds.")
      .def("__repr__", [](const Tree& self) {
        return "<shaftcull.TriangleTree of " + std::to_string(self.size()) + " triangles>";
      });
}

}  // namespace shaftcull::python
