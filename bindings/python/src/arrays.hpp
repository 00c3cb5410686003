// SPDX-License-Identifier: MIT
/// NumPy arrays that callers give: what they must be, and where their numbers lie. Nothing is copied that the library
/// can read where it is, and nothing is rounded.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "shaftcull/shaftcull.hpp"

namespace shaftcull::python {

namespace py = pybind11;

/// "(3, 6)"
[[nodiscard]] std::string shape_of(const py::array& array);

/// Any number of float32 as an array. Arrays must have that dtype; lists and tuples of Python's numbers may hold
/// whatever is a float32 exactly. TypeError or ValueError otherwise, with what would be right: `name` is that of the
/// argument, and `rounding` a function of this package that makes float32 of float64, or null.
[[nodiscard]] py::array_t<float> floats_in(const py::object& given, const std::string& name,
                                           const char* rounding = nullptr);

/// The same array if its numbers lie one behind the other in memory, else a copy of which they do.
[[nodiscard]] py::array_t<float> in_c_order(const py::array_t<float>& array);

/// Boxes of an argument. They lie in the memory of `kept`, which they must not outlive.
struct BoxesIn {
  std::variant<StridedBoxes, BoxView> where;
  std::size_t count = 0;
  bool one = false;  ///< a single box, of shape (6,) or (2, 3)
  std::vector<py::object> kept;
  bool copied = false;  ///< whether columns had to be copied to lie in streams
};
/// (n, 6), (n, 2, 3), a tuple (lo, hi) of (n, 3), a tuple of six arrays (n,), or one box: (6,), (2, 3), a tuple of two
/// (3,).
[[nodiscard]] BoxesIn boxes_in(const py::object& given, const std::string& name);

struct SpheresIn {
  std::variant<StridedSpheres, SphereView> where;
  std::size_t count = 0;
  bool one = false;
  std::vector<py::object> kept;
  bool copied = false;
};
/// (n, 4), a tuple (centres, radii) of (n, 3) and (n,), a tuple of four arrays (n,), or one sphere: (4,).
[[nodiscard]] SpheresIn spheres_in(const py::object& given, const std::string& name);

struct TrianglesIn {
  std::variant<std::span<const Triangle>, TriangleView, MeshView> where;
  std::size_t count = 0;
  std::vector<py::object> kept;
  bool copied = false;
  std::vector<std::uint32_t> indices;  ///< of a mesh, if they had to be converted
};
/// (n, 3, 3) or (n, 9); with faces (f, 3) of integers: vertices (v, 3).
[[nodiscard]] TrianglesIn triangles_in(const py::object& given, const py::object& faces, const std::string& name);

/// Vectors or points, (n, 3) or one (3,).
struct VectorsIn {
  py::array_t<float> array;  // owns the memory, in C order
  std::span<const Vec3> vectors;
  bool one = false;
};
[[nodiscard]] VectorsIn vectors_in(const py::object& given, const std::string& name);

/// Planes, (n, k, 4), k for each of n boxes, or (k, 4) for the same planes for all; none of None. `boxes` of them.
[[nodiscard]] std::vector<Plane> planes_in(const py::object& given, const std::string& name, std::size_t boxes);

/// The 16 floats of a matrix of shape (4, 4), row after row.
[[nodiscard]] py::array_t<float> matrix_in(const py::object& given, const std::string& name);

/// Integers of any width. IndexError for one that is negative or not below `limit`, which numbers `things`.
struct IndicesIn {
  std::vector<std::uint32_t> indices;
  std::vector<std::size_t> shape;
};
[[nodiscard]] IndicesIn indices_in(const py::object& given, const std::string& name, std::size_t limit,
                                   const std::string& things);

/// Sets of 32 layers, as integers from 0 to 2³² − 1: one, or (n,).
[[nodiscard]] std::vector<std::uint32_t> layers_in(const py::object& given, const std::string& name);

/// bool (n,) as words of 64 bits.
[[nodiscard]] std::vector<std::uint64_t> bits_in(const py::object& given, const std::string& name, std::size_t count);

/// A number of things, or nothing of None.
[[nodiscard]] std::optional<std::size_t> number_in(const py::object& given, const std::string& name);

}  // namespace shaftcull::python
