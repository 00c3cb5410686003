// SPDX-License-Identifier: MIT
/// Speed by number of bounds, of shafts and of threads.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "report/plot.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

/// The results called PREFIX/number or PREFIX/number/SUFFIX, as points (number, 10⁹ tests a second).
std::vector<Point> points_of(const BenchSummary& summary, const std::string& prefix, const std::string& suffix) {
  std::vector<Point> points;
  for (const auto& [name, result] : summary.results) {
    std::string_view rest = name;
    if (!rest.starts_with(prefix + '/')) continue;
    rest.remove_prefix(prefix.size() + 1);
    double x = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), x);
    if (error != std::errc() || !(x > 0)) continue;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (rest == (suffix.empty() ? "" : '/' + suffix)) points.push_back({x, result.per_second / 1e9});
  }
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  return points;
}

/// Adds a curve, unless it has fewer than two points.
void add(std::vector<Curve>& curves, Curve curve) {
  if (curve.points.size() >= 2) curves.push_back(std::move(curve));
}

double top_of(const std::vector<Curve>& curves) {
  double most = 0;
  for (const Curve& curve : curves) {
    for (const Point& point : curve.points) most = std::max(most, point.y);
  }
  return std::ceil(most * 1.05);
}

std::pair<double, double> ends_of(const std::vector<Curve>& curves) {
  double least = curves.front().points.front().x;
  double most = least;
  for (const Curve& curve : curves) {
    least = std::min(least, curve.points.front().x);
    most = std::max(most, curve.points.back().x);
  }
  return {least, most};
}

std::string axes(double top, const std::string& x_label) {
  return fmt::format(
      "set yrange [0:{}]\nset format y '%.0f G'\nset grid noxtics\n"
      "set label 'tests a second' at graph 0,1.07 left offset char -4,0 textcolor rgb '{}'\n"
      "set xlabel '{}' textcolor rgb '{}' offset 0,0.3\n",
      top, colour(ink_muted), x_label, colour(ink_muted));
}

/// AVX2 and the best instruction set, once each.
std::vector<const Look*> looks_of_curves(const BenchSummary& summary) {
  std::vector<const Look*> chosen;
  if (const Look* const avx2 = look_of("avx2")) chosen.push_back(avx2);
  const Look* const best = best_look(summary);
  if (best != nullptr && chosen.front() != best) chosen.push_back(best);
  return chosen;
}

/// 48 KiB, 2 MiB.
std::string size_text(double bytes) {
  return bytes < 1048576 ? fmt::format("{:.0f} KiB", bytes / 1024) : fmt::format("{:.0f} MiB", bytes / 1048576);
}

/// Vertical lines where boxes fill a cache.
std::string cache_lines(const BenchSummary& summary, double least, double most) {
  constexpr double box_bytes = 24;
  std::string script;
  for (const Cache& cache : summary.caches) {
    const double bounds = cache.bytes / box_bytes;
    if (cache.type == "Instruction" || bounds < least || bounds > most) continue;
    script += fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 nohead back lw 1 dt (2,3) lc rgb '{1}'\n",
                          bounds, colour(ink_muted));
    script += fmt::format("set label 'L{}, {}' at {}, graph 0.04 left offset char 0.5,0 textcolor rgb '{}'\n",
                          cache.level, size_text(cache.bytes), bounds, colour(ink_muted));
  }
  return script;
}

}  // namespace

std::optional<Plot> plot_bounds(const BenchSummary& summary) {
  std::vector<Curve> curves;
  for (const Look* const look : looks_of_curves(summary)) {
    add(curves, {fmt::format("{:.0f} shafts, {}", summary.shafts, look->label), look->ink, look->mark, false,
                 points_of(summary, "sweep/bounds", look->isa)});
    add(curves, {fmt::format("1 shaft, {}", look->label), look->ink, look->mark, true,
                 points_of(summary, "sweep/one_shaft", look->isa)});
  }
  if (curves.empty()) return std::nullopt;
  const double top = top_of(curves);
  const auto [least, most] = ends_of(curves);
  std::string script = preamble({.right = 0.74}) + axes(top, "boxes") + cache_lines(summary, least, most);
  script += "set logscale x 2\nset xtics (";
  const char* separator = "";
  for (std::uint64_t at = 1024; static_cast<double>(at) <= most; at *= 4) {
    script += fmt::format("{}'{}' {}", separator,
                          at < 1048576 ? fmt::format("{} K", at / 1024) : fmt::format("{} M", at / 1048576), at);
    separator = ", ";
  }
  script += fmt::format(")\nset xrange [{}:{}]\n", least, most);
  return Plot{
      "By number of boxes",
      "Many shafts share what they read, so their speed does not depend on how many boxes there are; one shaft reads "
      "every box anew, and steps down where boxes outgrow a cache.",
      draw_curves(script, curves, top)};
}

std::optional<Plot> plot_shafts(const BenchSummary& summary) {
  std::vector<Curve> curves;
  for (const Look* const look : looks_of_curves(summary)) {
    add(curves, {look->label, look->ink, look->mark, false, points_of(summary, "sweep/shafts", look->isa)});
  }
  if (curves.empty()) return std::nullopt;
  const double top = top_of(curves);
  const auto [least, most] = ends_of(curves);
  std::string script = preamble({.right = 0.86}) + axes(top, "shafts");
  script += fmt::format("set logscale x 2\nset xtics 4\nset format x '%.0f'\nset xrange [{}:{}]\n", least, most);
  return Plot{"By number of shafts",
              fmt::format("One thread, {} boxes. Each shaft more makes more of the boxes that were read.",
                          grouped(static_cast<unsigned long long>(summary.bounds / 4))),
              draw_curves(script, curves, top)};
}

std::optional<Plot> plot_threads(const BenchSummary& summary) {
  const Look* const best = best_look(summary);
  if (best == nullptr) return std::nullopt;
  std::vector<Curve> curves;
  add(curves, {fmt::format("{:.0f} shafts", summary.shafts), best->ink, best->mark, false,
               points_of(summary, "sweep/threads", "")});
  add(curves, {"1 shaft", best->ink, best->mark, true, points_of(summary, "sweep/threads_one_shaft", "")});
  if (curves.empty()) return std::nullopt;
  const auto [least, most] = ends_of(curves);
  Curve ideal{"in proportion", ink_muted, 0, true, {}};
  for (const double threads : {least, most}) {
    ideal.points.push_back({threads, curves.front().points.front().y * threads / curves.front().points.front().x});
  }
  curves.insert(curves.begin(), ideal);
  const double top = top_of(curves);
  std::string script = preamble({.right = 0.80}) + axes(top, "threads");
  script += fmt::format("set xtics {}\nset format x '%.0f'\nset xrange [{}:{}]\n",
                        std::max(1.0, std::ceil((most - least) / 8)), least, most);
  return Plot{"By number of threads",
              fmt::format("{}, {} boxes, by the clock on the wall.", best->label,
                          grouped(static_cast<unsigned long long>(summary.bounds))),
              draw_curves(script, curves, top)};
}

}  // namespace shaftcull::cli
