// SPDX-License-Identifier: MIT
/// Dot plots: a row for each job, a dot for each instruction set.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/plot.hpp"

namespace shaftcull::cli {

/// A dot, or a tick if it marks something to compare with.
struct Dot {
  const Look* look;  ///< null for a tick of no instruction set
  double x;
};

struct DotRow {
  std::string label;
  std::vector<Dot> dots;  ///< at least one, slowest instruction set first
  std::vector<Dot> ticks;
};

/// Rows from top to bottom, with a legend of instruction sets above them and what value_text() says of the largest
/// value at the right end of each. `axis` sets range, scale and tics of x.
[[nodiscard]] Drawing draw_dots(const std::vector<DotRow>& rows, const std::string& axis,
                                const std::function<std::string(double)>& value_text);

}  // namespace shaftcull::cli
