// SPDX-License-Identifier: MIT
#include "report/plot.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace shaftcull::cli {

std::string colour(Ink ink) { return fmt::format("#{0:02x}{0:02x}{0:02x}", static_cast<int>(ink)); }

const Look* look_of(const std::string& isa) {
  for (const Look& look : looks) {
    if (look.isa == isa) return &look;
  }
  return nullptr;
}

const Look* best_look(const BenchSummary& summary) {
  const Look* best = nullptr;
  for (const std::string& isa : summary.isas) {
    if (const Look* const look = look_of(isa)) best = look;
  }
  return best;
}

std::string preamble(const Frame& frame) {
  return fmt::format(
      "set terminal svg size {},{} dynamic noenhanced rounded font 'sans-serif,13'\n"
      "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen {}\nset tmargin at screen {}\n"
      "set border 1 lc rgb '{}'\nset tics nomirror scale 0 textcolor rgb '{}'\nset grid lt 1 lw 1 lc rgb '{}'\nset key "
      "off\n",
      frame.width, frame.height, frame.left, frame.right, frame.bottom, frame.top, colour(ink_muted), colour(ink_muted),
      colour(ink_grid));
}

Drawing draw_curves(std::string script, const std::vector<Curve>& curves, double top) {
  constexpr double least_distance = 0.065;  // of the height of the plot: a line of text
  struct Label {
    const Curve* curve;
    double height;
  };
  std::vector<Label> labels;
  std::vector<std::string> tooltips;
  std::string command;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& curve = curves[i];
    script += fmt::format("$curve{} << END\n", i);
    for (const Point& point : curve.points) script += fmt::format("{} {}\n", point.x, point.y);
    script += "END\n";
    command += fmt::format("{} $curve{} using 1:2 with linespoints lc rgb '{}' lw 2 dt {} pt {} ps 0.7",
                           i == 0 ? "plot" : ",", i, colour(curve.ink), curve.dashed ? "(6,4)" : "1", curve.mark);
    labels.push_back({&curve, curve.points.back().y / top});
    const Point& best = *std::max_element(curve.points.begin(), curve.points.end(),
                                          [](const Point& a, const Point& b) { return a.y < b.y; });
    tooltips.push_back(fmt::format("{}: up to {:.2f} G tests a second", curve.name, best.y));
  }
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.height < b.height; });
  // Pairs that are too close move apart by the same amount, until none is.
  for (int round = 0; round < 100; ++round) {
    for (std::size_t i = 1; i < labels.size(); ++i) {
      const double lack = least_distance - (labels[i].height - labels[i - 1].height);
      if (lack <= 0) continue;
      labels[i].height += lack / 2;
      labels[i - 1].height -= lack / 2;
    }
  }
  for (const Label& label : labels) {
    script += fmt::format("set label '{}' at graph 1.02,{} left textcolor rgb '{}'\n", label.curve->name, label.height,
                          colour(label.curve->ink));
  }
  return {script + command + '\n', tooltips};
}

}  // namespace shaftcull::cli
