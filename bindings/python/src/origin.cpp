// SPDX-License-Identifier: MIT
/// The class Origin: bounds of a world in doubles, relative to a point of it.
#include "shaftcull/origin.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bounds_in.hpp"
#include "module.hpp"

namespace shaftcull::python {

namespace {

/// An argument as doubles: (n, numbers), or (numbers,) for one.
Doubles doubles_in(const py::object& given, const std::string& name, py::ssize_t numbers) {
  Doubles array(numbers_in(given, name, {true, "it must be numbers"}));
  const bool one = array.ndim() == 1 && array.shape(0) == numbers;
  const bool many = array.ndim() == 2 && array.shape(1) == numbers;
  const bool none = array.ndim() == 1 && array.size() == 0;
  if (!one && !many && !none) {
    const std::string k = std::to_string(numbers);
    refuse_shape(name, array, "(n, " + k + "), or (" + k + ",) for one");
  }
  return array;
}

/// Records of doubles as records of floats, in an array of the same shape.
template <class From, class To, class Convert>
py::array_t<float> relative_records(const Doubles& from, Convert&& convert) {
  py::array_t<float> to(std::vector<py::ssize_t>(from.shape(), from.shape() + from.ndim()));
  const auto count = static_cast<std::size_t>(from.size()) * sizeof(double) / sizeof(From);
  const std::span in(reinterpret_cast<const From*>(from.data()), count);
  const std::span out(reinterpret_cast<To*>(to.mutable_data()), count);
  const py::gil_scoped_release release;
  convert(in, out);
  return to;
}

WorldVec3 point_in(const py::object& given, const std::string& name) {
  const Doubles array = doubles_in(given, name, 3);
  if (array.ndim() != 1 || array.size() != 3) refuse_shape(name, array, "(3,)");
  return {array.data()[0], array.data()[1], array.data()[2]};
}

py::array_t<double> coordinates_of(const WorldVec3& point) { return py::array_t<double>(3, point.data()); }

Origin origin_for_points(const py::object& given) {
  const Doubles array = doubles_in(given, "points", 3);
  if (array.size() == 0) throw py::value_error("points is empty; an origin is near one or more");
  WorldBox world{{array.data()[0], array.data()[1], array.data()[2]}, {}};
  world.hi = world.lo;
  for (py::ssize_t i = 0; i != array.size(); ++i) {
    const auto axis = static_cast<std::size_t>(i % 3);
    const double number = array.data()[i];
    if (!std::isfinite(number)) throw py::value_error("points: point " + std::to_string(i / 3) + " is not finite");
    world.lo[axis] = std::min(world.lo[axis], number);
    world.hi[axis] = std::max(world.hi[axis], number);
  }
  return Origin::for_world(world);
}

py::array_t<float> relative_boxes(const Origin& origin, const py::object& given, bool within) {
  return relative_records<WorldBox, Box>(doubles_in(given, "boxes", 6), [&](auto in, auto out) {
    within ? origin.within(in, out) : origin.around(in, out);
  });
}

py::array_t<float> relative_spheres(const Origin& origin, const py::object& given) {
  return relative_records<WorldSphere, Sphere>(doubles_in(given, "spheres", 4),
                                               [&](auto in, auto out) { origin.around(in, out); });
}

py::array_t<float> relative_planes(const Origin& origin, const py::object& given, const py::object& given_box) {
  const Doubles planes = doubles_in(given, "planes", 4);
  const Doubles box = doubles_in(given_box, "box", 6);
  if (box.ndim() != 1 || box.size() != 6) refuse_shape("box", box, "(6,)");
  const auto& world = *reinterpret_cast<const WorldBox*>(box.data());
  return relative_records<WorldPlane, Plane>(planes, [&](auto in, auto out) { origin.around(in, world, out); });
}

py::array_t<float> relative_points(const Origin& origin, const py::object& given) {
  return relative_records<WorldVec3, Vec3>(doubles_in(given, "points", 3),
                                           [&](auto in, auto out) { origin.nearest(in, out); });
}

py::array_t<double> world_points(const Origin& origin, const py::object& given) {
  const py::array_t<float> array = floats_in(given, "points");
  static_cast<void>(is_one_vector(array, "points"));
  py::array_t<double> world(std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()));
  for (py::ssize_t i = 0; i != array.size(); ++i) {
    world.mutable_data()[i] = origin.at()[static_cast<std::size_t>(i % 3)] + array.data()[i];
  }
  return world;
}

std::string text_of_origin(const Origin& origin) {
  return "Origin(" + py::repr(coordinates_of(origin.at()).attr("tolist")()).cast<std::string>() + ")";
}

}  // namespace

void add_origin(py::module_& module) {
  using py::arg;
  py::class_<Origin>(module, "Origin", R"(
A point of a world in float64 to which coordinates are relative. Near the origin, floats are fine. A bound
that is outside the shaft between two boxes from boxes() is outside in the world, too. Make solids that hide,
and boxes that are to contain others, with within=True. Values that bounds and shafts refuse are not refused
here: NaN and lo > hi stay.)")
      .def(py::init([](const py::object& at) { return Origin(point_in(at, "at")); }),
           arg("at") = py::make_tuple(0, 0, 0),
           "at: (3,), by default the origin of the world. ValueError for a point that is not finite.")
      .def_static("for_points", &origin_for_points, arg("points"), R"(
An origin near the middle of points (n, 3), such as the corners of a scene. Its coordinates are multiples of
a power of two. ValueError for no points, and for a point that is not finite.)")
      .def_property_readonly(
          "at", [](const Origin& origin) { return coordinates_of(origin.at()); }, R"(
The point of the world where the origin is: float64 (3,).)")
      .def("boxes", &relative_boxes, arg("boxes"), py::kw_only(), arg("within") = false, R"(
The smallest float32 boxes that contain the given boxes; with within=True, the largest float32 boxes within
them, or the empty box if there is none. float32 of the same shape.

boxes: (n, 6) of lo and hi, or (6,) for one. TypeError or ValueError for other arrays. Other threads of
    Python continue.)")
      .def("spheres", &relative_spheres, arg("spheres"), R"(
Spheres of float32 that contain the given spheres: centres are rounded to nearest, and radii grow. float32 of
the same shape.

spheres: (n, 4) of centre and radius, or (4,) for one. TypeError or ValueError for other arrays. Other
    threads of Python continue.)")
      .def("planes", &relative_planes, arg("planes"), arg("box"), R"(
Planes of float32 that keep all points of a box that the given planes keep: normal . p <= offset. Normals are
rounded to nearest, and offsets grow. float32 of the same shape.

planes: (n, 4) of normal and offset, or (4,) for one. box: (6,) of lo and hi, in the world. TypeError or
    ValueError for other arrays, and for what is not finite or is beyond the largest float32. Other threads of
    Python continue.)")
      .def("points", &relative_points, arg("points"), R"(
The nearest float32 to each coordinate, for vertices of triangles, corners of patches and points of hulls.
float32 of the same shape.

points: (n, 3), or (3,) for one. TypeError or ValueError for other arrays. Other threads of Python continue.)")
      .def("to_world", &world_points, arg("points"), R"(
The positions of points in the world: float64 of the same shape.

points: float32 (n, 3), or (3,) for one. TypeError or ValueError for other arrays.)")
      .def("__repr__", &text_of_origin)
      .def(
          "__eq__", [](const Origin& one, const Origin& other) { return one == other; }, arg("other"),
          py::is_operator())
      .def("__hash__", [](const Origin& origin) {
        const WorldVec3& at = origin.at();
        return py::hash(py::make_tuple(at[0], at[1], at[2]));
      });
}

}  // namespace shaftcull::python
