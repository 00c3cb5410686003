// SPDX-License-Identifier: MIT
/// Lines of a file, written many at a time.
#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "output_file.hpp"

namespace shaftcull::cli {

class TextLines {
 public:
  explicit TextLines(OutputFile& file) : file_(file) {}

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    if (text_.size() >= at_once) write();
  }
  /// What was added and is not written yet.
  void write() {
    file_.write(text_);
    text_.clear();
  }

 private:
  static constexpr std::size_t at_once = std::size_t{1} << 20;

  OutputFile& file_;
  std::string text_;
};

}  // namespace shaftcull::cli
