// SPDX-License-Identifier: MIT
/// Arguments that are boxes, spheres or triangles: what Python calls them, which shapes are taken, and where their
/// numbers lie. Nothing is copied that the library can read where it is.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull::python {

/// What differs between the kinds of bounds: types, and words of docstrings and messages.
template <class Bound>
struct Kind;

template <>
struct Kind<Box> {
  using View = BoxView;
  using Rows = StridedBoxes;
  using Stream = BoxStream;
  using Tree = BoxTree;
  static constexpr const char* name = "Box";  ///< in the names of classes
  static constexpr const char* title = "Boxes";
  static constexpr const char* plural = "boxes";
  static constexpr const char* shapes =
      "(n, 6) of lo and hi, (n, 2, 3), a tuple (lo, hi) of (n, 3), a tuple of six (n,), or (6,) or (2, 3) for one";
  static constexpr const char* columns = "a transpose of (6, n), numpy.asfortranarray(boxes), or a tuple of six (n,)";
  static constexpr const char* bad = "NaN and lo > hi; lo = infinity and hi = -infinity is the empty box";
  static constexpr const char* option = "rounding";
  static constexpr const char* about_option = R"(
rounding: 'outwards' also accepts float64, and rounds lo down and hi up: boxes that are outside are then
    outside as given, too. Round solids (occluded()) to nearest instead: a larger solid hides too much.)";
};

template <>
struct Kind<Sphere> {
  using View = SphereView;
  using Rows = StridedSpheres;
  using Stream = SphereStream;
  using Tree = SphereTree;
  static constexpr const char* name = "Sphere";
  static constexpr const char* title = "Spheres";
  static constexpr const char* plural = "spheres";
  static constexpr const char* shapes =
      "(n, 4) of centre and radius, a tuple (centres, radii) of (n, 3) and (n,), a tuple of four (n,), or (4,) for one";
  static constexpr const char* columns =
      "a transpose of (4, n), numpy.asfortranarray(spheres), or a tuple of four (n,)";
  static constexpr const char* bad = "NaN, centres that are not finite, and radii below 0";
  static constexpr const char* option = "rounding";
  static constexpr const char* about_option = R"(
rounding: 'outwards' also accepts float64. Centres are rounded to nearest, and radii grow: each sphere
    contains the given sphere.)";
};

template <>
struct Kind<Triangle> {
  using View = TriangleView;
  using Rows = std::span<const Triangle>;
  using Stream = TriangleStream;
  using Tree = TriangleTree;
  static constexpr const char* name = "Triangle";
  static constexpr const char* title = "Triangles";
  static constexpr const char* plural = "triangles";
  static constexpr const char* shapes = "(n, 3, 3), (n, 9), a tuple of nine (n,), or vertices (v, 3) with faces (f, 3)";
  static constexpr const char* columns =
      "a transpose of (9, n), numpy.asfortranarray(triangles), or a tuple of nine (n,)";
  static constexpr const char* bad = "coordinates that are not finite";
  static constexpr const char* option = "faces";
  static constexpr const char* about_option = R"(
faces: integers (f, 3), counted from 0: the vertices of each triangle. IndexError for an index out of range.

Triangles are never rounded outwards, since no float32 triangle need contain a given float64 triangle:
triangles.astype(numpy.float32) rounds to nearest.)";
};

/// Bounds of an argument. They lie in the memory of `kept`, and a mesh in that of `indices`.
template <class Bound>
struct BoundsIn {
  using Place = std::conditional_t<std::is_same_v<Bound, Triangle>,
                                   std::variant<TriangleView, std::span<const Triangle>, MeshView>,
                                   std::variant<typename Kind<Bound>::View, typename Kind<Bound>::Rows>>;
  Place where;
  std::size_t count = 0;
  bool one = false;     ///< without the axis of bounds
  bool copied = false;  ///< whether the library could not read the argument where it is
  std::vector<py::object> kept;
  std::vector<std::uint32_t> indices;
};

/// Boxes, spheres or triangles, of the shapes that their Kind names. Values are not checked.
template <class Bound>
[[nodiscard]] BoundsIn<Bound> bounds_in(const py::object& given, const std::string& name, const Rounding& rounding);

/// The same with the option that a kind has: `rounding` of boxes and spheres, `faces` of triangles.
template <class Bound>
[[nodiscard]] BoundsIn<Bound> bounds_in(const py::object& given, const py::object& option) {
  return bounds_in<Bound>(given, Kind<Bound>::plural, rounding_in(option));
}
template <>
[[nodiscard]] BoundsIn<Triangle> bounds_in<Triangle>(const py::object& given, const py::object& option);

/// Boxes in streams. BadBound names the argument.
[[nodiscard]] BoxStream packed(const StridedBoxes& boxes, const std::string& name);

/// Boxes of an argument in streams. Errors name the argument.
class BoxesInStreams {
 public:
  BoxesInStreams(const py::object& given, const std::string& name, const Rounding& rounding);

  [[nodiscard]] const BoxView& view() const noexcept { return view_; }
  [[nodiscard]] std::size_t count() const noexcept { return in_.count; }
  [[nodiscard]] bool one() const noexcept { return in_.one; }

 private:
  BoundsIn<Box> in_;
  BoxStream packed_;
  BoxView view_;
};

/// The largest float that is not above a number, and the least that is not below.
[[nodiscard]] float rounded_down(double number) noexcept;
[[nodiscard]] float rounded_up(double number) noexcept;

}  // namespace shaftcull::python
