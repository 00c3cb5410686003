// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "module.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

using Hull = std::shared_ptr<ConvexHull>;

ClipDepth depth_in(const std::string& depth) {
  if (depth == "zero_to_one") return ClipDepth::zero_to_one;
  if (depth == "minus_one_to_one") return ClipDepth::minus_one_to_one;
  throw py::value_error("depth is '" + depth + "'; it must be 'zero_to_one' or 'minus_one_to_one'");
}

Vec3 vector_in(const py::object& given, const std::string& name) {
  const VectorsIn in = vectors_in(given, name);
  if (!in.one) throw py::value_error(name + " has shape " + shape_of(in.array) + "; it must be (3,)");
  return in.vectors[0];
}

Hull hull_of(const py::object& points, const py::object& directions) {
  const VectorsIn ends = vectors_in(points, "points");
  const VectorsIn ways = directions.is_none() ? VectorsIn{} : vectors_in(directions, "directions");
  const py::gil_scoped_release release;
  return std::make_shared<ConvexHull>(ends.vectors, ways.vectors);
}

std::span<const float, 16> sixteen(const py::array_t<float>& matrix) {
  return std::span<const float, 16>(matrix.data(), 16);
}

}  // namespace

void add_hulls(py::module_& module) {
  using py::arg;
  py::class_<ConvexHull, Hull>(module, "ConvexHull", R"(
The convex hull of up to 32 points and directions, which goes where one shaft goes: view frusta, what casts shadows
into view, volumes between polygons.

points: float32 (n, 3). directions: float32 (m, 3); with them the hull has no end that way.

Boxes are answered exactly, spheres to the safe side, triangles by their vertices only (test='vertices'). Refused are
questions for times and for what blocks, and open contact.)")
      .def(py::init(&hull_of), arg("points"), arg("directions") = py::none())
      .def_static(
          "frustum",
          [](const py::object& matrix, const std::string& depth) {
            const py::array_t<float> floats = matrix_in(matrix, "matrix");
            const ClipDepth in_view = depth_in(depth);
            const py::gil_scoped_release release;
            return std::make_shared<ConvexHull>(frustum(sixteen(floats), in_view));
          },
          arg("matrix"), arg("depth") = "zero_to_one", R"(
What a view-projection matrix shows.

matrix: float32 (4, 4), that maps column vectors: matrix @ (x, y, z, 1) is in clip space.
depth: 'zero_to_one' (Direct3D, Vulkan, Metal) or 'minus_one_to_one' (OpenGL).)")
      .def(
          "casters",
          [](const ConvexHull& view, const py::object& light) {
            const Vec3 position = vector_in(light, "light");
            const py::gil_scoped_release release;
            return std::make_shared<ConvexHull>(casters(view, position));
          },
          arg("light"), "What can cast a shadow into this view by a light at a point, float32 (3,).")
      .def(
          "casters_towards",
          [](const ConvexHull& view, const py::object& towards_sun) {
            const Vec3 direction = vector_in(towards_sun, "towards_sun");
            const py::gil_scoped_release release;
            return std::make_shared<ConvexHull>(casters_towards(view, direction));
          },
          arg("towards_sun"), "What can cast a shadow into this view by a sun, whose direction is float32 (3,).")
      .def_property_readonly(
          "box", [](const ConvexHull& hull) { return array_of(hull.box()); },
          "float32 (6,): the box around the hull, infinite where directions lead.")
      .def_property_readonly(
          "points", [](const ConvexHull& hull) { return array_of(hull.points()); }, "float32 (n, 3), as given.")
      .def_property_readonly(
          "directions", [](const ConvexHull& hull) { return array_of(hull.directions()); }, "float32 (m, 3), as given.")
      .def("__repr__", [](const ConvexHull& hull) {
        return "<shaftcull.ConvexHull of " + std::to_string(hull.points().size()) + " points and " +
               std::to_string(hull.directions().size()) + " directions>";
      });

  module.def(
      "view_planes",
      [](const py::object& matrix, const std::string& depth) {
        const py::array_t<float> floats = matrix_in(matrix, "matrix");
        const ViewPlanes planes = view_planes(sixteen(floats), depth_in(depth));
        py::array_t<float> array({static_cast<py::ssize_t>(planes.count), py::ssize_t{4}});
        float* to = array.mutable_data();
        for (const Plane& plane : planes) {
          for (const float coordinate : plane.normal) *to++ = coordinate;
          *to++ = plane.offset;
        }
        return array;
      },
      arg("matrix"), arg("depth") = "zero_to_one", R"(
The planes of a view frustum, float32 (k, 4) with k up to 6, normals outwards: to cut shafts to what is in view.

matrix, depth: as those of ConvexHull.frustum().)");
}

}  // namespace shaftcull::python
