// SPDX-License-Identifier: MIT
/// The roofline: what memory and arithmetic allow, and where culling boxes with more and more shafts lies below it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "report/plot.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

constexpr double box_bytes = 24;

struct Slope {
  const char* benchmark;
  const char* label;
};
constexpr std::array slopes{Slope{"roofline/read_l1_bytes/", "L1"}, Slope{"roofline/read_l2_bytes/", "L2"},
                            Slope{"roofline/read_l3_bytes/", "L3"}, Slope{"roofline/read_dram_bytes/", "memory"}};

constexpr Frame roofline_frame{.width = 1152, .height = 440, .left = 0.045, .right = 0.84, .bottom = 0.12, .top = 0.90};

/// The x axis: shafts that share what is read, which is tests for each byte but for a factor.
constexpr double least_x = 0.22;
constexpr double most_x = 1536;

/// Tests for each byte that is read once for `shafts` shafts.
double intensity(double shafts) { return shafts / box_bytes; }

struct Axes {
  double least_y;
  double most_y;

  /// Units of the picture for a factor of 10 upwards.
  [[nodiscard]] double decade_up() const {
    return roofline_frame.height * (roofline_frame.top - roofline_frame.bottom) / std::log10(most_y / least_y);
  }
  /// Degrees of a line of slope 1 on both logarithmic axes.
  [[nodiscard]] double angle() const {
    const double decade_across =
        roofline_frame.width * (roofline_frame.right - roofline_frame.left) / std::log10(most_x / least_x);
    return std::atan2(decade_up(), decade_across) * 180 / std::numbers::pi;
  }
};

/// What reading from a cache or from memory allows: a line that rises with the shafts that share what is read.
struct Bandwidth {
  const char* label;
  double bytes_per_second;

  [[nodiscard]] double tests(double shafts) const { return bytes_per_second * intensity(shafts); }
};

/// Lines of bandwidths, fastest first, each with its label along it: above the line, or below it if the line above is
/// so close that they would overprint.
std::string draw_bandwidths(const std::vector<Bandwidth>& bandwidths, double highest, const Axes& axes) {
  constexpr double text_height = 20;
  std::string script;
  double above = 0;
  for (const Bandwidth& line : bandwidths) {
    const double end = std::min(most_x, highest / line.tests(1));
    script += fmt::format("set arrow from {},{} to {},{} nohead lw 1.5 lc rgb '{}'\n", least_x, line.tests(least_x),
                          end, line.tests(end), colour(ink_muted));
    const bool has_room = above == 0 || axes.decade_up() * std::log10(above / line.bytes_per_second) >= text_height;
    const double x = least_x * (has_room ? 1.08 : 1.2);
    script += fmt::format(
        "set label '{}, {:.0f} GB/s' at {},{} left rotate by {:.1f} offset char 0,{} textcolor rgb '{}'\n", line.label,
        line.bytes_per_second / 1e9, x, line.tests(x), axes.angle(), has_room ? 0.7 : -0.9, colour(ink_muted));
    above = line.bytes_per_second;
  }
  return script;
}

/// What a kind of arithmetic allows, in tests a second (bench/families/roofline.cpp).
struct Roof {
  const Look* look;
  const char* numbers;
  double rate;
};

std::vector<Roof> roofs_of(const BenchSummary& summary) {
  std::vector<Roof> roofs;
  for (const Look& look : looks) {
    if (const auto rate = summary.speed(std::string("roofline/slab_arithmetic/") + look.isa))
      roofs.push_back({&look, "floats", *rate});
    if (const auto rate = summary.speed(std::string("roofline/grid_arithmetic/") + look.isa))
      roofs.push_back({&look, "16 bits", *rate});
  }
  return roofs;
}

/// Where the roofs' labels stand: at their rates, or above them, so that none is written over another.
std::vector<double> label_heights(const std::vector<Roof>& roofs) {
  constexpr double line = 1.3;
  std::vector<std::size_t> by_rate(roofs.size());
  std::iota(by_rate.begin(), by_rate.end(), std::size_t{0});
  std::sort(by_rate.begin(), by_rate.end(),
            [&](std::size_t a, std::size_t b) { return roofs[a].rate < roofs[b].rate; });
  std::vector<double> heights(roofs.size());
  double free_from = 0;
  for (const std::size_t i : by_rate) {
    heights[i] = std::max(roofs[i].rate, free_from);
    free_from = heights[i] * line;
  }
  return heights;
}

/// Points at 1, 2, 4, … shafts.
std::vector<Point> points_of(const BenchSummary& summary, const Look& look) {
  std::vector<Point> points;
  for (int shafts = 1; shafts <= 1024; shafts *= 2) {
    const auto speed = summary.speed(fmt::format("sweep/shafts/{}/{}", shafts, look.isa));
    if (speed) points.push_back({static_cast<double>(shafts), *speed});
  }
  return points;
}

}  // namespace

std::optional<Plot> plot_roofline(const BenchSummary& summary) {
  const std::vector<Roof> roofs = roofs_of(summary);
  if (roofs.empty()) return std::nullopt;
  const Roof& highest =
      *std::max_element(roofs.begin(), roofs.end(), [](const Roof& a, const Roof& b) { return a.rate < b.rate; });
  std::vector<Bandwidth> bandwidths;
  for (const Slope& slope : slopes) {
    const auto rate = summary.speed(std::string(slope.benchmark) + highest.look->isa);
    // Where reading allows more than arithmetic from the left end on, there is no line to see.
    if (rate && *rate * intensity(least_x) < highest.rate) bandwidths.push_back({slope.label, *rate});
  }
  if (bandwidths.empty()) return std::nullopt;
  std::sort(bandwidths.begin(), bandwidths.end(),
            [](const Bandwidth& a, const Bandwidth& b) { return a.bytes_per_second > b.bytes_per_second; });
  double least_y = bandwidths.back().tests(least_x);
  for (const Roof& roof : roofs) {
    for (const Point& point : points_of(summary, *roof.look)) least_y = std::min(least_y, point.y);
  }
  const Axes axes{least_y * 0.7, highest.rate * 1.6};

  std::string script = preamble(roofline_frame);
  script += fmt::format(
      "set logscale xy\nset xrange [{}:{}]\nset yrange [{}:{}]\nset grid noxtics\n"
      "set ytics ('0.05 G' 5e7, '0.1 G' 1e8, '0.2 G' 2e8, '0.5 G' 5e8, '1 G' 1e9, '2 G' 2e9, '5 G' 5e9, '10 G' 1e10, "
      "'20 G' 2e10, '50 G' 5e10)\n"
      "set xtics ('1' 1, '2' 2, '4' 4, '8' 8, '16' 16, '32' 32, '64' 64, '128' 128, '256' 256, '512' 512, '1,024' "
      "1024)\n"
      "set label 'tests a second' at graph 0,1.05 left offset char -4,0 textcolor rgb '{}'\n"
      "set xlabel 'shafts that share what is read' textcolor rgb '{}' "
      "offset 0,0.3\n",
      least_x, most_x, axes.least_y, axes.most_y, colour(ink_muted), colour(ink_muted));
  script += draw_bandwidths(bandwidths, highest.rate, axes);
  const std::vector<double> heights = label_heights(roofs);
  std::string command = "plot NaN";
  std::vector<std::string> tooltips{""};
  for (std::size_t i = 0; i < roofs.size(); ++i) {
    const auto& [look, numbers, rate] = roofs[i];
    const double begin = std::max(least_x, rate / bandwidths.front().tests(1));
    script += fmt::format("set arrow from {},{} to {},{} nohead lw 1.5 lc rgb '{}'\n", begin, rate, most_x, rate,
                          colour(look->ink));
    script += fmt::format("set label '{}, {}: {:.1f} G' at graph 1.01, first {} left textcolor rgb '{}'\n", look->label,
                          numbers, rate / 1e9, heights[i], colour(look->ink));
    if (i != 0 && roofs[i - 1].look == look) continue;  // one curve of points each
    const std::vector<Point> points = points_of(summary, *look);
    if (points.empty()) continue;
    script += fmt::format("$points{} << END\n", i);
    for (const Point& point : points) script += fmt::format("{} {}\n", point.x, point.y);
    script += "END\n";
    command += fmt::format(", $points{} using 1:2 with linespoints lc rgb '{}' lw 1 pt {} ps 0.8", i, colour(look->ink),
                           look->mark);
    tooltips.push_back(fmt::format("{}: {} tests a second with {:.0f} shafts", look->label, prefixed(points.back().y),
                                   points.back().x));
  }
  return Plot{"Roofline",
              fmt::format("A box takes {} bytes. Left of the bend reading is the limit, right of it arithmetic: of "
                          "floats, or, for groups of eight "
                          "shafts and more, of 16-bit integers. Reading was measured on six streams, with {}; points "
                          "are {} boxes, one thread.",
                          box_bytes, highest.look->label, grouped(static_cast<unsigned long long>(summary.bounds / 4))),
              {script + command + '\n', tooltips},
              true};
}

}  // namespace shaftcull::cli
