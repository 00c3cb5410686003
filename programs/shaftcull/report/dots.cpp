// SPDX-License-Identifier: MIT
#include "report/dots.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

/// Room for labels of rows on the left, and for values on the right.
constexpr Frame dots_frame{.height = 380, .left = 0.31, .right = 0.87, .bottom = 0.09, .top = 0.93};

/// The names of the instruction sets there are, with their marks, side by side above the rows.
std::string legend(const std::vector<DotRow>& rows) {
  constexpr double pitch = 0.25;  // of the width of the plot: room for the longest name
  std::string script;
  double x = 0;
  for (const Look& look : looks) {
    const bool shown = std::any_of(rows.begin(), rows.end(), [&](const DotRow& row) {
      return std::any_of(row.dots.begin(), row.dots.end(), [&](const Dot& dot) { return dot.look == &look; });
    });
    if (!shown) continue;
    script += fmt::format(
        "set label '{}' at graph {},1.05 left point pt {} ps 1 lc rgb '{}' offset char 1,0 textcolor rgb '{}'\n",
        look.label, x, look.mark, colour(look.ink), colour(look.ink));
    x += pitch;
  }
  return script;
}

}  // namespace

Drawing draw_dots(const std::vector<DotRow>& rows, const std::string& axis,
                  const std::function<std::string(double)>& value_text) {
  const auto height = static_cast<double>(rows.size());
  std::string script = preamble(dots_frame) + axis + legend(rows);
  script += fmt::format("set yrange [0.4:{}]\nset grid noytics\nunset ytics\n", height + 0.6);
  std::string command = "plot NaN";
  std::vector<std::string> tooltips{""};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const DotRow& row = rows[r];
    const double y = height - static_cast<double>(r);
    script += fmt::format("set label '{}' at graph -0.02, first {} right textcolor rgb '{}'\n", row.label, y,
                          colour(ink_text));
    const auto [least, most] =
        std::minmax_element(row.dots.begin(), row.dots.end(), [](const Dot& a, const Dot& b) { return a.x < b.x; });
    script += fmt::format("set arrow from {},{} to {},{} nohead back lw 1.5 lc rgb '{}'\n", least->x, y, most->x, y,
                          colour(ink_grid));
    script += fmt::format("set label '{}' at graph 1.18, first {} right textcolor rgb '{}'\n", value_text(most->x), y,
                          colour(most->look->ink));
    for (const Dot& tick : row.ticks) {
      script += fmt::format("set arrow from {0},{1} to {0},{2} nohead front lw 2 lc rgb '{3}'\n", tick.x, y - 0.3,
                            y + 0.3, colour(tick.look == nullptr ? ink_muted : tick.look->ink));
    }
    for (const Dot& dot : row.dots) {
      command += fmt::format(", '+' using ({}):({}) every ::0::0 with points pt {} ps 1 lc rgb '{}'", dot.x, y,
                             dot.look->mark, colour(dot.look->ink));
      tooltips.push_back(fmt::format("{}, {}: {}", row.label, dot.look->label, value_text(dot.x)));
    }
  }
  return {script + command + '\n', tooltips};
}

}  // namespace shaftcull::cli
