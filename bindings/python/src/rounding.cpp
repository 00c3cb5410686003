// SPDX-License-Identifier: MIT
/// float64 to float32 outwards: what is made contains what was given.

#include <cmath>
#include <limits>

#include "arrays.hpp"
#include "module.hpp"

namespace shaftcull::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The largest float that is not above.
float rounded_down(double x) {
  const auto nearest = static_cast<float>(x);
  return static_cast<double>(nearest) > x ? std::nextafter(nearest, -infinity) : nearest;
}
/// The least float that is not below.
float rounded_up(double x) {
  const auto nearest = static_cast<float>(x);
  return static_cast<double>(nearest) < x ? std::nextafter(nearest, infinity) : nearest;
}

Doubles doubles_in(const py::object& given, const std::string& name) {
  const py::object array = py::module_::import("numpy").attr("asarray")(given);
  const char kind = py::reinterpret_borrow<py::array>(array).dtype().kind();
  if ((kind != 'f' && kind != 'i' && kind != 'u') || py::reinterpret_borrow<py::array>(array).itemsize() > 8) {
    throw py::type_error(name + " has dtype " + py::str(array.attr("dtype")).cast<std::string>() +
                         "; it must be float64, or numbers that float64 holds");
  }
  if (kind != 'f' && py::reinterpret_borrow<py::array>(array).itemsize() == 8) {
    const py::object back = array.attr("astype")("float64").attr("astype")(array.attr("dtype"));
    if (!py::module_::import("numpy").attr("array_equal")(back, array).cast<bool>()) {
      throw py::type_error(name + " holds integers that float64 does not");
    }
  }
  return Doubles(array);
}

py::array_t<float> boxes_outwards(const py::object& boxes) {
  py::object given = boxes;
  if (py::isinstance<py::tuple>(boxes) && py::len(boxes) == 2) {
    const auto pair = py::reinterpret_borrow<py::tuple>(boxes);
    given = py::module_::import("numpy").attr("stack")(
        py::make_tuple(doubles_in(pair[0], "lo"), doubles_in(pair[1], "hi")), -2);
  }
  const Doubles in = doubles_in(given, "boxes");
  std::vector<py::ssize_t> shape(in.shape(), in.shape() + in.ndim());
  const std::size_t axes = shape.size();
  if (axes >= 2 && shape[axes - 1] == 3 && shape[axes - 2] == 2) {
    shape.pop_back();
    shape.back() = 6;
  }
  if (shape.empty() || shape.size() > 2 || shape.back() != 6) {
    throw py::value_error("boxes have shape " + shape_of(in) +
                          "; it must be (n, 6), (n, 2, 3), a tuple (lo, hi) of (n, 3), or (6,) or (2, 3) for one box");
  }
  py::array_t<float> out(shape);
  const double* const from = in.data();
  float* const to = out.mutable_data();
  const auto size = static_cast<std::size_t>(in.size());
  const py::gil_scoped_release release;
  for (std::size_t i = 0; i != size; ++i) to[i] = i % 6 < 3 ? rounded_down(from[i]) : rounded_up(from[i]);
  return out;
}

py::array_t<float> spheres_outwards(const py::object& spheres) {
  py::object given = spheres;
  if (py::isinstance<py::tuple>(spheres) && py::len(spheres) == 2) {
    const auto pair = py::reinterpret_borrow<py::tuple>(spheres);
    given = py::module_::import("numpy").attr("column_stack")(
        py::make_tuple(doubles_in(pair[0], "centres"), doubles_in(pair[1], "radii")));
  }
  const Doubles in = doubles_in(given, "spheres");
  const bool one = in.ndim() == 1 && in.shape(0) == 4;
  if (!one && (in.ndim() != 2 || in.shape(1) != 4)) {
    throw py::value_error("spheres have shape " + shape_of(in) +
                          "; it must be (n, 4), a tuple (centres, radii) of (n, 3) and (n,), or (4,) for one sphere");
  }
  py::array_t<float> out(std::vector<py::ssize_t>(in.shape(), in.shape() + in.ndim()));
  const double* from = in.data();
  float* to = out.mutable_data();
  const auto count = static_cast<std::size_t>(in.size()) / 4;
  const py::gil_scoped_release release;
  for (std::size_t i = 0; i != count; ++i, from += 4, to += 4) {
    // The radius grows by what the centre moves, and by more than the sums and roots of doubles can be wrong.
    double moved = 0;
    for (std::size_t axis = 0; axis != 3; ++axis) {
      to[axis] = static_cast<float>(from[axis]);
      moved += std::fabs(from[axis] - static_cast<double>(to[axis]));
    }
    constexpr double more = 1 + 8 * std::numeric_limits<double>::epsilon();
    to[3] = from[3] < 0 || moved == 0 ? rounded_up(from[3]) : rounded_up((from[3] + moved) * more);
  }
  return out;
}

py::array_t<float> point_boxes(const py::object& points) {
  const VectorsIn in = vectors_in(points, "points");
  const auto count = static_cast<py::ssize_t>(in.vectors.size());
  py::array_t<float> out(in.one ? std::vector<py::ssize_t>{6} : std::vector<py::ssize_t>{count, 6});
  float* to = out.mutable_data();
  for (const Vec3& point : in.vectors) {
    for (std::size_t i = 0; i != 6; ++i) *to++ = point[i % 3];
  }
  return out;
}

}  // namespace

void add_rounding(py::module_& module) {
  using py::arg;
  module.def("round_outwards", &boxes_outwards, arg("boxes"), R"(
The smallest float32 boxes that contain boxes of float64: lo rounded down, hi rounded up. What is outside for them is
outside for the boxes that were given.

boxes: float64 (n, 6), (n, 2, 3), a tuple (lo, hi) of (n, 3), or (6,) or (2, 3) for one.
Returns float32 (n, 6) or (6,).)");
  module.def("round_spheres_outwards", &spheres_outwards, arg("spheres"), R"(
float32 spheres that contain spheres of float64: centres rounded to nearest, radii grown by as much and rounded up.

spheres: float64 (n, 4), a tuple (centres, radii) of (n, 3) and (n,), or (4,) for one.
Returns float32 of that shape.)");
  module.def("points", &point_boxes, arg("points"), R"(
Boxes that are points, for viewpoints and point lights: float32 (n, 3) to (n, 6), or (3,) to (6,).)");
}

}  // namespace shaftcull::python
