#include "report/dots.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

/// Room for labels of rows on the left, and for values on the right.
constexpr Frame frame{.height = 380, .left = 0.31, .right = 0.87, .bottom = 0.09, .top = 0.93};

/// The name of a dot's instruction set above it: ending there, but for the one farthest to the right, which begins
/// there, so that names of dots close together stay apart.
std::string name_above(const Dot& dot, double y, bool rightmost) {
  return fmt::format("set label '{}' at {},{} {} offset char {},1 textcolor rgb '{}'\n", dot.look->label, dot.x, y,
                     rightmost ? "left" : "right", rightmost ? -0.5 : 0.8, colour(dot.look->ink));
}

}  // namespace

std::string draw_dots(const std::vector<DotRow>& rows, const std::string& axis,
                      const std::function<std::string(double)>& value_text) {
  const auto height = static_cast<double>(rows.size());
  std::string script = preamble(frame) + axis;
  script += fmt::format("set yrange [0.4:{}]\nset grid noytics\nunset ytics\n", height + 0.6);
  std::string command = "plot NaN";
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
      if (r == 0) script += name_above(dot, y, dot.look == most->look);
    }
  }
  return script + command + '\n';
}

}  // namespace shaftcull::cli
