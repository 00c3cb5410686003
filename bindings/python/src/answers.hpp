// SPDX-License-Identifier: MIT
/// The questions that bounds are asked, and their answers as arrays. The lock is released while the library works.
#pragma once

#include <pybind11/pybind11.h>

#include "options.hpp"

namespace shaftcull::python {

/// A question: about which bounds, of which shafts, with which options.
struct Question {
  Bounds bounds;
  const Shafts& shafts;
  const Options& options;
};

// answers.cpp: bits, bools and numbers.
py::object ask_cull(const Question& question, bool packed);
py::object ask_classify(const Question& question, bool packed);
py::object ask_any(const Question& question);
py::object ask_count(const Question& question);
py::object ask_count_classified(const Question& question);
py::object ask_occluded(const Question& question);

// lists.cpp: indices and times.
py::object ask_list(const Question& question, bool times);
py::object ask_list_classified(const Question& question);
py::object ask_first_contact(const Question& question);
py::object ask_find_occluder(const Question& question);
py::object ask_list_occluders(const Question& question);
py::object ask_entry_times(Holder& holder, const py::object& shaft, const py::object& indices);

}  // namespace shaftcull::python
