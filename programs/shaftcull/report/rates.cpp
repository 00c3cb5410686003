// SPDX-License-Identifier: MIT
/// Speed by instruction set and form: in tests a second, against the paper's method, and against what limits it.
#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "report/dots.hpp"
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

}  // namespace

std::optional<Plot> plot_rates(const BenchSummary& summary) {
  std::vector<DotRow> rows;
  for (const Job& job : jobs) {
    DotRow row{job.label, {}, {}};
    for (const Look& look : looks) {
      if (const auto speed = summary.speed(std::string(job.benchmark) + look.isa)) row.dots.push_back({&look, *speed});
    }
    if (row.dots.empty()) continue;
    if (const auto paper = summary.speed(job.paper)) row.ticks.push_back({nullptr, *paper});
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return std::nullopt;
  const std::string axis =
      "set logscale x\nset xrange [8e7:2e10]\n"
      "set xtics ('100 M' 1e8, '1 G' 1e9, '10 G' 1e10, '' 2e8 1, '' 5e8 1, '' 2e9 1, '' 5e9 1)\n";
  return Plot{"Tests a second, by instruction set and form",
              fmt::format("One thread, {} shafts × {} bounds, results as bits. The grey tick is the paper's method.",
                          summary.shafts, grouped(static_cast<unsigned long long>(summary.bounds))),
              draw_dots(rows, axis, [](double speed) { return prefixed(speed); })};
}

std::optional<Plot> plot_ratios(const BenchSummary& summary) {
  const auto target_of = [&](const std::string& name) -> std::optional<double> {
    for (const ReachRow& row : summary.reach) {
      if (row.row == name && row.against.starts_with("paper/")) return row.target;
    }
    return std::nullopt;
  };
  const Look* const best = best_look(summary);
  std::vector<DotRow> rows;
  const auto add = [&](DotRow& row, const std::string& name, const Look& look) {
    const auto found = summary.results.find(name);
    if (found == summary.results.end() || !found->second.vs_paper) return;
    row.dots.push_back({&look, *found->second.vs_paper});
    if (const auto target = target_of(name)) row.ticks.push_back({&look, *target});
  };
  for (const Job& job : jobs) {
    DotRow row{job.label, {}, {}};
    for (const Look& look : looks) add(row, std::string(job.benchmark) + look.isa, look);
    if (!row.dots.empty()) rows.push_back(std::move(row));
  }
  DotRow formation{"forming shafts, batch", {}, {}};
  if (best != nullptr) add(formation, "form/batch", *best);
  if (!formation.dots.empty()) rows.push_back(std::move(formation));
  if (rows.empty()) return std::nullopt;
  const std::string axis =
      "set logscale x\nset xrange [0.9:140]\n"
      "set xtics ('1 ×' 1, '2 ×' 2, '5 ×' 5, '10 ×' 10, '20 ×' 20, '50 ×' 50, '100 ×' 100)\n";
  return Plot{
      "Times as fast as the paper's method",
      "From the same run. Ticks are targets, in the colour of their instruction set.",
      draw_dots(rows, axis, [](double ratio) { return fmt::format("{:.{}f} ×", ratio, ratio < 9.95 ? 1 : 0); })};
}

std::optional<Plot> plot_shares(const BenchSummary& summary) {
  struct Path {
    const char* prefix;
    const char* label;
  };
  std::vector<Path> paths;
  for (const Job& job : jobs) paths.push_back({job.benchmark, job.label});
  paths.push_back({"memory/cull/", "1 shaft, from memory"});
  const Look* const best = best_look(summary);
  std::vector<DotRow> rows;
  for (const auto& [prefix, label] : paths) {
    DotRow row{label, {}, {}};
    for (const PathLimit& path : summary.limits) {
      for (const Look& look : looks) {
        if (path.row == std::string(prefix) + look.isa) row.dots.push_back({&look, path.fraction});
      }
    }
    if (!row.dots.empty()) rows.push_back(std::move(row));
  }
  for (const PathLimit& path : summary.limits) {
    if (path.row == "form/batch" && best != nullptr)
      rows.push_back({"forming shafts, batch", {{best, path.fraction}}, {}});
  }
  if (rows.empty()) return std::nullopt;
  const std::string axis = fmt::format(
      "set xrange [0:1.1]\nset xtics ('0' 0, '25 %%' 0.25, '50 %%' 0.5, '75 %%' 0.75, '100 %%' 1)\n"
      "set arrow from 1, graph 0 to 1, graph 1 nohead back lw 1.5 lc rgb '{}'\n",
      colour(ink_muted));
  return Plot{"Share of what the machine allows",
              "Of the lowest of the limits that arithmetic and memory set to each path; the table below names them.",
              draw_dots(rows, axis, [](double share) { return fmt::format("{:.0f} %", 100 * share); })};
}

}  // namespace shaftcull::cli
