// SPDX-License-Identifier: MIT
/// A table of text with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace shaftcull::cli {

class Table {
 public:
  explicit Table(std::vector<std::string> header);
  /// As many cells as the header has.
  void add_row(std::vector<std::string> cells);
  /// Lines, each ended by a newline: the header, a rule, the rows. The first column is flush left, all others right.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// A count with grouped digits: 5380840 → "5,380,840".
[[nodiscard]] std::string grouped(unsigned long long count);

/// A count with its noun: "1 ray", "1,200 rays". Without `plural`, the plural is the noun with an s.
[[nodiscard]] std::string counted(unsigned long long count, const std::string& noun, const std::string& plural = {});

/// A cell of a CSV file: in quotes if that is needed.
[[nodiscard]] std::string csv_cell(const std::string& text);

/// A rate with a unit prefix: 4.21e9 → "4.21 G".
[[nodiscard]] std::string prefixed(double rate);

}  // namespace shaftcull::cli
