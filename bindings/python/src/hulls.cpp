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

HullTest hull_test_in(const std::string& test) {
  if (test == "exact") return HullTest::exact;
  if (test == "conservative") return HullTest::conservative;
  throw py::value_error("test is '" + test + "'; it must be 'exact' or 'conservative'");
}

Hull hull_of(const py::object& points, const py::object& directions, const std::string& test) {
  const VectorsIn ends = vectors_in(points, "points");
  const VectorsIn ways = directions.is_none() ? VectorsIn{} : vectors_in(directions, "directions");
  const HullTest by = hull_test_in(test);
  const py::gil_scoped_release release;
  return std::make_shared<ConvexHull>(ends.vectors, ways.vectors, by);
}

Hull hull_between(const py::object& p, const py::object& q, const std::string& test) {
  const VectorsIn first = vectors_in(p, "p");
  const VectorsIn second = vectors_in(q, "q");
  const HullTest by = hull_test_in(test);
  const py::gil_scoped_release release;
  return std::make_shared<ConvexHull>(between_polygons(first.vectors, second.vectors, by));
}

/// A view-projection matrix, whose 16 floats lie row after row.
py::array_t<float> matrix_in(const py::object& given) {
  py::array_t<float> matrix = floats_in(given, "matrix");
  if (matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4) refuse_shape("matrix", matrix, "(4, 4)");
  return matrix;
}

std::span<const float, 16> sixteen(const py::array_t<float>& matrix) {
  return std::span<const float, 16>(matrix.data(), 16);
}

/// What can cast a shadow into a view by light from a point or a direction.
template <ConvexHull (*Casters)(const ConvexHull&, const Vec3&)>
Hull casters_of(const ConvexHull& view, const py::object& given, const char* name) {
  const VectorsIn in = vectors_in(given, name);
  if (!in.one) refuse_shape(name, in.array, "(3,)");
  const py::gil_scoped_release release;
  return std::make_shared<ConvexHull>(Casters(view, in.vectors[0]));
}

}  // namespace

void add_hulls(py::module_& module) {
  using py::arg;
  py::class_<ConvexHull, Hull>(module, "ConvexHull", R"(
The convex hull of up to 32 points and directions: a view frustum, the volume whose objects cast shadows into
a view, the volume between polygons. It can be used wherever one shaft can.

points: float32 (n, 3), 1 to 32 together with the directions. directions: float32 (m, 3), not 0: the hull has
    no end in these directions. float64 raises TypeError, since a hull of rounded points need not contain the
    given hull.
test: 'exact' or 'conservative'. With 'conservative', boxes are outside only if they are beyond one face, as
    in the usual test of a view by its planes. This test is faster, and keeps some boxes beside edges and
    corners. Casters have the test of their view.

Answers for boxes and triangles are exact; answers for spheres err to the safe side. Queries for times refuse
a hull. Queries for occluders refuse a hull that was not made by between_polygons(). Contact is closed;
Shafts.concatenate([hull]).with_contact('open') leaves out bounds that only touch the hull.)")
      .def(py::init(&hull_of), arg("points"), arg("directions") = py::none(), arg("test") = "exact")
      .def_static("between_polygons", &hull_between, arg("p"), arg("q"), arg("test") = "exact", R"(
The ConvexHull of two ends, such as polygons or turned boxes. Each end is the convex hull of its corners.
Queries about occluders accept this hull: they find solids that hide one end from the other.

p, q: float32 (n, 3), corners in any order, 1 or more each and at most 32 together. test: as for ConvexHull.

TypeError or ValueError for other arguments.)")
      .def_static(
          "frustum",
          [](const py::object& matrix, const std::string& depth, const std::string& test) {
            const py::array_t<float> floats = matrix_in(matrix);
            const ClipDepth in_view = depth_in(depth);
            const HullTest by = hull_test_in(test);
            const py::gil_scoped_release release;
            return std::make_shared<ConvexHull>(frustum(sixteen(floats), in_view, by));
          },
          arg("matrix"), arg("depth"), arg("test") = "exact", R"(
The volume that a view-projection matrix shows: a ConvexHull.

matrix: float32 (4, 4) that maps column vectors: matrix @ (x, y, z, 1) is in clip space. Round a matrix of
    float64 with astype(numpy.float32).
depth: 'zero_to_one' (Direct3D, Vulkan, Metal) or 'minus_one_to_one' (OpenGL).
test: as for ConvexHull.

TypeError or ValueError for other arguments, and for a matrix that cannot be inverted.)")
      .def(
          "casters",
          [](const ConvexHull& view, const py::object& light) { return casters_of<&casters>(view, light, "light"); },
          arg("light"), R"(
The ConvexHull of all points that can cast a shadow into this view, from a light at a point.

light: float32 (3,). TypeError or ValueError for other arguments, and if the hull would need more than 32
    corners.)")
      .def(
          "casters_towards",
          [](const ConvexHull& view, const py::object& towards_sun) {
            return casters_of<&casters_towards>(view, towards_sun, "towards_sun");
          },
          arg("towards_sun"), R"(
The ConvexHull of all points that can cast a shadow into this view, from a sun in a direction.

towards_sun: float32 (3,), not 0. TypeError or ValueError for other arguments.)")
      .def_property_readonly(
          "box", [](const ConvexHull& hull) { return array_of(hull.box()); },
          "float32 (6,): the box around the hull, infinite on the sides to which directions lead.")
      .def_property_readonly(
          "points", [](const ConvexHull& hull) { return rows_of(hull.points()); }, "float32 (n, 3), as given.")
      .def_property_readonly(
          "directions", [](const ConvexHull& hull) { return rows_of(hull.directions()); }, "float32 (m, 3), as given.")
      .def_property_readonly(
          "test", [](const ConvexHull& hull) { return hull.test() == HullTest::exact ? "exact" : "conservative"; },
          "'exact' or 'conservative', as given.")
      .def("__repr__", [](const ConvexHull& hull) {
        return "<shaftcull.ConvexHull of " + std::to_string(hull.points().size()) + " points and " +
               std::to_string(hull.directions().size()) + " directions>";
      });

  module.def(
      "view_planes",
      [](const py::object& matrix, const std::string& depth) {
        const ViewPlanes planes = view_planes(sixteen(matrix_in(matrix)), depth_in(depth));
        return rows_of(std::span<const Plane>(planes.begin(), planes.end()));
      },
      arg("matrix"), arg("depth"), R"(
The planes of a view frustum, with normals outwards, for cutting shafts to the view: float32 (k, 4), k up to
6, normal and offset.

matrix, depth: as for ConvexHull.frustum(). TypeError or ValueError for other arguments.)");
}

}  // namespace shaftcull::python
