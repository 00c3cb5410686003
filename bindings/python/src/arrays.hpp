// SPDX-License-Identifier: MIT
/// Arguments that are arrays: which dtypes and shapes are taken, and what refuses the others. Nothing is rounded
/// silently.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shaftcull/shaftcull.hpp"

namespace shaftcull::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// "(3, 6)"
[[nodiscard]] std::string shape_of(const py::array& array);

/// ValueError: the argument has its shape, and must have a right one.
[[noreturn]] void refuse_shape(const std::string& name, const py::array& array, const std::string& right);

/// What becomes of numbers that are no float32: they are rounded outwards, or refused with advice.
struct Rounding {
  bool outwards;
  const char* advice;
};

/// For arguments that are never rounded outwards.
inline constexpr Rounding no_rounding{false, "array.astype(numpy.float32) rounds to nearest"};

/// The keyword `rounding`: None or 'outwards'.
[[nodiscard]] Rounding rounding_in(const py::object& rounding);

/// An argument as an array of float32; or of float64, if it is to be rounded outwards. Lists and tuples may hold any
/// number that is a float32. TypeError for others.
[[nodiscard]] py::array numbers_in(const py::object& given, const std::string& name, const Rounding& rounding);

/// An argument as float32 in C order, aligned: the same memory if it is so already.
[[nodiscard]] py::array_t<float> floats_in(const py::object& given, const std::string& name);

/// Whether an array holds vectors: (n, 3), or (3,) for one, or nothing at all. ValueError otherwise.
[[nodiscard]] bool is_one_vector(const py::array& array, const std::string& name);

/// Vectors or points.
struct VectorsIn {
  py::array_t<float> array;  // owns the memory
  std::span<const Vec3> vectors;
  bool one = false;
};
[[nodiscard]] VectorsIn vectors_in(const py::object& given, const std::string& name);

/// Planes of each of `count` things, one behind the other; none of None. With 2 axes one plane for each, (n, 4), or
/// (4,) for all; with 3 axes k planes for each, (n, k, 4), or (k, 4) for all.
[[nodiscard]] std::vector<Plane> planes_in(const py::object& given, const std::string& name, std::size_t count,
                                           py::ssize_t axes);

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
