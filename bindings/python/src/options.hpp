// SPDX-License-Identifier: MIT
/// The options of a question: keywords of Python as a shaftcull::Query. Both have the same names.
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

/// Numbers of the caller's are copied, so that no other thread changes them meanwhile. Errors name the keyword.
class Options {
 public:
  /// What is left out of these bounds, for these shafts. None for an option that is not given.
  Options(const Shafts& shafts, const Holder& bounds, const py::object& exclude, const py::object& exclude_each,
          const py::object& exclude_mask, const py::object& layer_mask);

  void set_limit(const py::object& limit);
  void set_only(const py::object& only);
  void set_triangle_test(const std::string& test);

  /// The query of the shafts [first, first + count). It refers to these options.
  [[nodiscard]] Query of(std::size_t first, std::size_t count) const;

 private:
  std::size_t shafts_;
  std::size_t bounds_;
  std::vector<std::uint32_t> exclude_;
  std::vector<std::uint32_t> exclude_each_;
  std::vector<std::uint64_t> exclude_mask_;
  std::vector<std::uint32_t> layer_mask_;
  std::size_t limit_ = Query::no_limit;
  std::optional<std::vector<std::uint32_t>> only_;
  TriangleTest triangle_test_ = TriangleTest::exact;
};

}  // namespace shaftcull::python
