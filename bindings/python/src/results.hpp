// SPDX-License-Identifier: MIT
/// Results as NumPy arrays, which own their memory: a vector is moved behind the array, not copied.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "shaftcull/shaftcull.hpp"

namespace shaftcull::python {

namespace py = pybind11;

/// The type that NumPy's users count with: int64 for 64 bits, which no count or offset here fills.
template <class Number>
using InNumPy = std::conditional_t<std::is_same_v<Number, std::uint64_t>, std::int64_t, Number>;

/// An array of one axis that owns the numbers of a vector.
template <class Number>
[[nodiscard]] py::array array_of(std::vector<Number>&& numbers) {
  if (numbers.empty()) return py::array_t<InNumPy<Number>>(0);
  auto owner = std::make_unique<std::vector<Number>>(std::move(numbers));
  const auto size = static_cast<py::ssize_t>(owner->size());
  const auto* const data = reinterpret_cast<const InNumPy<Number>*>(owner->data());
  const py::capsule capsule(owner.get(), [](void* vector) { delete static_cast<std::vector<Number>*>(vector); });
  static_cast<void>(owner.release());  // the capsule deletes it
  return py::array_t<InNumPy<Number>>(size, data, capsule);
}

/// A copy of indices.
[[nodiscard]] inline py::array copy_of(std::span<const std::uint32_t> indices) {
  return array_of(std::vector<std::uint32_t>(indices.begin(), indices.end()));
}

/// Boxes (n, 6), vectors (n, 3), planes (n, 4): the floats that each consists of.
template <class Struct>
[[nodiscard]] py::array_t<float> rows_of(std::span<const Struct> structs) {
  static_assert(std::is_trivially_copyable_v<Struct> && alignof(Struct) == alignof(float));
  py::array_t<float> array({structs.size(), sizeof(Struct) / sizeof(float)});
  if (!structs.empty()) std::memcpy(array.mutable_data(), structs.data(), structs.size_bytes());
  return array;
}

/// (6,): lo x, lo y, lo z, hi x, hi y, hi z
[[nodiscard]] inline py::array array_of(const Box& box) { return rows_of(std::span(&box, 1)).attr("ravel")(); }

/// Many lists, as shaftcull.IndexLists. `times` may be None.
[[nodiscard]] inline py::object lists_of(const py::object& offsets, const py::object& indices,
                                         const py::object& times = py::none()) {
  return py::module_::import("shaftcull").attr("IndexLists")(offsets, indices, times);
}

/// Rows of so many bits in words of 64, as bools unless they stay packed.
[[nodiscard]] inline py::object bits_of(const py::object& words, std::size_t bits, bool packed) {
  if (packed) return words;
  const py::object unpackbits = py::module_::import("numpy").attr("unpackbits");
  return unpackbits(words.attr("view")("uint8"), -1, bits, "little").attr("view")("bool");
}

/// A bool of Python's for one shaft, bool (n,) for many.
[[nodiscard]] inline py::object bools_of(bool one, std::vector<std::uint8_t>&& answers) {
  if (one) return py::bool_(answers[0] != 0);
  return array_of(std::move(answers)).attr("view")("bool");
}

}  // namespace shaftcull::python
