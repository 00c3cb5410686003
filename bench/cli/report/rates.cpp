/// Speed by instruction set and form, in tests a second and against the paper's method.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "report/plot.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

struct Job {
  const char* benchmark;
  const char* label;
  const char* paper;
};
constexpr std::array jobs{Job{"test/boxes/cull/slab/", "boxes, cull, slab", "paper/boxes_cull"},
                          Job{"test/boxes/cull/planes/", "boxes, cull, planes", "paper/boxes_cull"},
                          Job{"test/boxes/classify/slab/", "boxes, classify, slab", "paper/boxes_classify"},
                          Job{"test/boxes/classify/planes/", "boxes, classify, planes", "paper/boxes_classify"},
                          Job{"test/spheres/cull/slab/", "spheres, cull, slab", "paper/spheres_cull"},
                          Job{"test/spheres/cull/planes/", "spheres, cull, planes", "paper/spheres_cull"},
                          Job{"test/spheres/classify/slab/", "spheres, classify, slab", "paper/spheres_cull"},
                          Job{"test/spheres/classify/planes/", "spheres, classify, planes", "paper/spheres_cull"}};

/// A dot of an instruction set in the row of a job.
struct Dot {
  const Look* look;
  double x;
};

struct Row {
  std::string label;
  std::vector<Dot> dots;
  std::vector<Dot> ticks;  ///< targets, or what the row is compared with (no look)
};

/// Room for labels of rows on the left, and of values on the right.
constexpr Frame dot_frame{.height = 400, .left = 0.29, .right = 0.90, .bottom = 0.10, .top = 0.89};

/// Rows from top to bottom on a logarithmic axis; names of instruction sets above the dots of the first.
std::string draw(const std::vector<Row>& rows, const std::string& axis, const auto& value_text) {
  std::string script = preamble(dot_frame) + axis;
  const auto height = static_cast<double>(rows.size());
  script += fmt::format("set logscale x\nset yrange [0.4:{}]\nset grid noytics\nunset ytics\n", height + 0.6);
  std::string command = "plot NaN";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Row& row = rows[r];
    const double y = height - static_cast<double>(r);
    script += fmt::format("set label '{}' at graph -0.02, first {} right textcolor rgb '{}'\n", row.label, y,
                          colour(ink_text));
    const auto [least, most] =
        std::minmax_element(row.dots.begin(), row.dots.end(), [](const Dot& a, const Dot& b) { return a.x < b.x; });
    script += fmt::format("set arrow from {},{} to {},{} nohead back lw 1.5 lc rgb '{}'\n", least->x, y, most->x, y,
                          colour(ink_grid));
    script += fmt::format("set label '{}' at {},{} left offset char 1,0 textcolor rgb '{}'\n", value_text(most->x),
                          most->x, y, colour(ink_muted));
    for (const Dot& tick : row.ticks) {
      script += fmt::format("set arrow from {0},{1} to {0},{2} nohead front lw 2 lc rgb '{3}'\n", tick.x, y - 0.3,
                            y + 0.3, colour(tick.look == nullptr ? ink_muted : tick.look->ink));
    }
    for (const Dot& dot : row.dots) {
      command += fmt::format(", '+' using ({}):({}) every ::0::0 with points pt {} ps 1 lc rgb '{}'", dot.x, y,
                             dot.look->mark, colour(dot.look->ink));
      if (r != 0) continue;
      const bool last = &dot == &row.dots.back();
      script += fmt::format("set label '{}' at {},{} {} offset char {},1 textcolor rgb '{}'\n", dot.look->label, dot.x,
                            y, last ? "left" : "right", last ? -0.5 : 0.8, colour(dot.look->ink));
    }
  }
  return script + command + '\n';
}

}  // namespace

std::optional<Plot> plot_rates(const BenchSummary& summary) {
  std::vector<Row> rows;
  for (const Job& job : jobs) {
    Row row{job.label, {}, {}};
    for (const Look& look : looks) {
      if (const auto speed = summary.speed(std::string(job.benchmark) + look.isa)) row.dots.push_back({&look, *speed});
    }
    if (row.dots.empty()) continue;
    if (const auto paper = summary.speed(job.paper)) row.ticks.push_back({nullptr, *paper});
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return std::nullopt;
  const std::string axis =
      "set xrange [8e7:2e10]\n"
      "set xtics ('100 M' 1e8, '1 G' 1e9, '10 G' 1e10, '' 2e8 1, '' 5e8 1, '' 2e9 1, '' 5e9 1)\n";
  return Plot{"Tests a second, by instruction set and form",
              fmt::format("One thread, {} shafts × {} bounds, results as bits. The grey tick is the paper's method.",
                          summary.shafts, grouped(static_cast<unsigned long long>(summary.bounds))),
              draw(rows, axis, [](double speed) { return prefixed(speed); })};
}

std::optional<Plot> plot_ratios(const BenchSummary& summary) {
  const auto target_of = [&](const std::string& name) -> std::optional<double> {
    for (const ReachRow& row : summary.reach) {
      if (row.row == name && row.against.starts_with("paper/")) return row.target;
    }
    return std::nullopt;
  };
  const Look* const best = best_look(summary);
  std::vector<Row> rows;
  const auto add = [&](Row& row, const std::string& name, const Look& look) {
    const auto found = summary.results.find(name);
    if (found == summary.results.end() || !found->second.vs_paper) return;
    row.dots.push_back({&look, *found->second.vs_paper});
    if (const auto target = target_of(name)) row.ticks.push_back({&look, *target});
  };
  for (const Job& job : jobs) {
    Row row{job.label, {}, {}};
    for (const Look& look : looks) add(row, std::string(job.benchmark) + look.isa, look);
    if (!row.dots.empty()) rows.push_back(std::move(row));
  }
  Row formation{"forming shafts, batch", {}, {}};
  if (best != nullptr) add(formation, "form/batch", *best);
  if (!formation.dots.empty()) rows.push_back(std::move(formation));
  if (rows.empty()) return std::nullopt;
  const std::string axis =
      "set xrange [0.9:140]\n"
      "set xtics ('1 ×' 1, '2 ×' 2, '5 ×' 5, '10 ×' 10, '20 ×' 20, '50 ×' 50, '100 ×' 100)\n";
  return Plot{"Times as fast as the paper's method",
              "From the same run. Ticks are targets, in the colour of their instruction set.",
              draw(rows, axis, [](double ratio) { return fmt::format("{:.{}f} ×", ratio, ratio < 9.95 ? 1 : 0); })};
}

}  // namespace shaftcull::cli
