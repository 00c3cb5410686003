// SPDX-License-Identifier: MIT
/// What Python knows as shaftcull.Shafts and shaftcull.ConvexHull.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "arrays.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull::python {

namespace py = pybind11;

/// Compiled shafts, never changed once they are made, so that slices share them.
struct ShaftStorage {
  std::vector<CompiledShaft> compiled;
  std::vector<std::shared_ptr<const ConvexHull>> hulls;  ///< that some of the shafts refer to
};

/// A range of shafts, or one shaft: an array of one axis, or of none.
struct Shafts {
  std::shared_ptr<const ShaftStorage> storage;
  std::size_t first = 0;
  std::size_t count = 0;
  bool one = false;

  [[nodiscard]] std::span<const CompiledShaft> span() const noexcept {
    return {storage->compiled.data() + first, count};
  }
  [[nodiscard]] const CompiledShaft& front() const noexcept { return storage->compiled[first]; }
};

/// All shafts of new storage.
[[nodiscard]] Shafts shafts_of(ShaftStorage&& storage, bool one);

/// "closed" or "open"
[[nodiscard]] Contact contact_in(const std::string& contact);

/// Shafts between boxes, of which the one may be one for all of the other; with pairs of indices, between these.
[[nodiscard]] Shafts between(const py::object& a, const py::object& b, const py::object& pairs,
                             const py::object& planes_a, const py::object& planes_b, const std::string& contact,
                             const Rounding& rounding);

/// What a query is given: Shafts, a ConvexHull, or boxes a and b.
[[nodiscard]] Shafts shafts_in(const py::object& shafts, const py::object& b);

}  // namespace shaftcull::python
