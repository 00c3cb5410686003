// SPDX-License-Identifier: MIT
/// Queries: their options, which are keywords of Python, and their answers as arrays. The interpreter lock is released
/// while the library works.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "holders.hpp"
#include "shafts.hpp"

namespace shaftcull::python {

/// Indices that are the same for all shafts: one, or (k,). Errors name the keyword.
[[nodiscard]] std::vector<std::uint32_t> indices_for_all(const py::object& given, const char* name, std::size_t bounds);

/// "exact" or "vertices"
[[nodiscard]] TriangleTest triangle_test_in(const std::string& test);

/// The keywords of a query, which have the names that they have in shaftcull::Query: copies of the caller's numbers,
/// which no other thread can change.
struct Options {
  std::size_t shafts;
  std::size_t bounds;
  std::vector<std::uint32_t> exclude{};
  std::vector<std::uint32_t> exclude_each{};
  std::vector<std::uint64_t> exclude_mask{};
  std::vector<std::uint32_t> layer_mask{};
  std::size_t limit = Query::no_limit;
  std::optional<std::vector<std::uint32_t>> only{};
  bool skip_overlapping = false;
  TriangleTest triangle_test = TriangleTest::exact;

  /// Those that leave out bounds, for these shafts. None for one that is not given. Errors name the keyword.
  Options(const Shafts& asked, const Holder& holder, const py::object& to_exclude, const py::object& each,
          const py::object& mask, const py::object& layers);

  /// The query of the shafts [first, first + count). It refers to these options.
  [[nodiscard]] Query of(std::size_t first, std::size_t count) const;
};

/// What a query is about: bounds, shafts and options.
struct Question {
  Bounds bounds;
  const Shafts& shafts;
  const Options& options;
};

py::object ask_cull(const Question& question, bool packed);
py::object ask_classify(const Question& question, bool packed);
py::object ask_any(const Question& question);
py::object ask_count(const Question& question);
py::object ask_count_classified(const Question& question);
py::object ask_list(const Question& question, bool times);
py::object ask_list_classified(const Question& question);
py::object ask_first_contact(const Question& question, bool normals);
py::object ask_occluded(const Question& question);
py::object ask_find_occluder(const Question& question);
py::object ask_list_occluders(const Question& question);
py::object ask_entry_times(Holder& holder, const py::object& shaft, const py::object& indices);

}  // namespace shaftcull::python
