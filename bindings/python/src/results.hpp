// SPDX-License-Identifier: MIT
/// Results as NumPy arrays, which own their memory: a vector is moved behind the array, not copied.
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
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

/// (6,): lo x, lo y, lo z, hi x, hi y, hi z
[[nodiscard]] inline py::array_t<float> array_of(const Box& box) {
  py::array_t<float> array(6);
  for (std::size_t i = 0; i != 3; ++i) {
    array.mutable_data()[i] = box.lo[i];
    array.mutable_data()[i + 3] = box.hi[i];
  }
  return array;
}

/// (n, 3)
[[nodiscard]] inline py::array_t<float> array_of(std::span<const Vec3> vectors) {
  py::array_t<float> array({static_cast<py::ssize_t>(vectors.size()), py::ssize_t{3}});
  float* to = array.mutable_data();
  for (const Vec3& vector : vectors) {
    for (const float coordinate : vector) *to++ = coordinate;
  }
  return array;
}

/// offsets and indices, as a tuple
[[nodiscard]] inline py::tuple lists_of(IndexLists&& lists) {
  if (lists.offsets.empty()) lists.offsets.push_back(0);
  return py::make_tuple(array_of(std::move(lists.offsets)), array_of(std::move(lists.indices)));
}

/// Bits as bytes of 0 and 1: `count` of them.
void unpack(const std::uint64_t* words, std::size_t count, bool* to) noexcept;

}  // namespace shaftcull::python
