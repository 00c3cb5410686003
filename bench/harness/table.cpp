// SPDX-License-Identifier: MIT
#include "harness/table.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/verdict.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::bench {
namespace {

/// 5.1 G, 103 M: three digits and a prefix.
std::string speed_text(double per_second) {
  struct Unit {
    double size;
    const char* prefix;
  };
  for (const Unit unit : {Unit{1e9, " G"}, Unit{1e6, " M"}, Unit{1e3, " k"}}) {
    const double value = per_second / unit.size;
    if (value < 0.9995) continue;
    return fmt::format("{:.{}f}{}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0, unit.prefix);
  }
  return fmt::format("{:.1f}", per_second);
}

std::string ratio_text(const std::optional<double>& ratio) { return ratio ? fmt::format("{:.1f} ×", *ratio) : "–"; }

/// Right-aligned in a column; fmt counts what is seen, not bytes.
std::string cell(const std::string& text, int width) { return fmt::format("{:>{}}", text, width); }

struct Split {
  std::string row;
  std::optional<Isa> isa;  ///< if the name ends with one
};

Split split(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  if (slash == std::string::npos) return {name, {}};
  return {name.substr(0, slash), isa_from_name(name.substr(slash + 1))};
}

void print_list(const Suite& suite, const Results& results) {
  fmt::print("\n{:<42}{:>12}{:>12}{:>12}\n", "", "per second", "ns each", "vs paper");
  for (const Entry& entry : suite.entries()) {
    const std::optional<double> speed = results.per_second(entry.name);
    if (!speed || split(entry.name).isa) continue;
    const double each = 1e9 / *speed;
    fmt::print("{:<42}{}{}{}\n", entry.name, cell(speed_text(*speed), 12),
               cell(fmt::format("{:.{}f}", each, each < 1e5 ? 2 : 0), 12),
               cell(ratio_text(results.ratio(entry.name, entry.paper)), 12));
  }
}

/// Benchmarks whose names end with an instruction set: one row for all sets.
void print_by_instruction_set(const Suite& suite, const Results& results) {
  std::vector<std::string> rows;
  std::set<Isa> columns;
  for (const Entry& entry : suite.entries()) {
    const auto [row, isa] = split(entry.name);
    if (!isa || !results.per_second(entry.name)) continue;
    columns.insert(*isa);
    if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
  }
  if (rows.empty()) return;
  fmt::print("\n{:<42}", "per second, vs paper");
  for (const Isa isa : columns) fmt::print("{:>19}", name(isa));
  fmt::print("\n");
  for (const std::string& row : rows) {
    fmt::print("{:<42}", row);
    for (const Isa isa : columns) {
      std::string text = "–";
      for (const Entry& entry : suite.entries()) {
        const std::optional<double> speed = results.per_second(entry.name);
        if (entry.name != fmt::format("{}/{}", row, name(isa)) || !speed) continue;
        text = fmt::format("{} {:>8}", speed_text(*speed), ratio_text(results.ratio(entry.name, entry.paper)));
      }
      fmt::print("{}", cell(text, 19));
    }
    fmt::print("\n");
  }
}

/// 1.85 ×, 48.0 ×, 60 ns: small ratios to the digit that targets have.
std::string figure_text(const Target& target, double figure) {
  if (target.kind == Target::Kind::nanoseconds) return fmt::format("{:.1f} ns", figure);
  return fmt::format("{:.{}f} ×", figure, figure < 9.995 ? 2 : 1);
}

void print_targets(const Suite& suite, const Results& results) {
  if (suite.targets().empty()) return;
  fmt::print("\n{:<42}{:>12}{:>12}\n", "to be reached", "measured", "target");
  for (const Target& target : suite.targets()) {
    if (!results.per_second(target.measured)) continue;  // left out by --filter
    const std::optional<double> figure = measured_figure(target, results);
    const char* const verdict = !figure ? "not measured" : is_met(target, *figure) ? "met" : "MISSED";
    const std::string meaning = target.kind == Target::Kind::speed_ratio  ? "× " + target.against
                                : target.kind == Target::Kind::time_ratio ? "at most, × the time of " + target.against
                                                                          : "at most";
    fmt::print("{:<42}{}{}   {} ({})\n", target.measured, cell(figure ? figure_text(target, *figure) : "–", 12),
               cell(figure_text(target, target.figure), 12), verdict, meaning);
  }
}

void print_limits(const Suite& suite, const Results& results) {
  const std::vector<PathLimits> paths = limits_of_paths(suite, results);
  if (paths.empty()) return;
  fmt::print("\n{:<42}{:>12}{:>12}{:>10}   {}\n", "limits", "per second", "allowed", "share", "limited by");
  for (const PathLimits& path : paths) {
    const Ceiling& least = path.ceilings.front();
    fmt::print("{:<42}{}{}{}   {} ({})\n", path.path, cell(speed_text(path.per_second), 12),
               cell(speed_text(least.per_second), 12), cell(fmt::format("{:.2f}", path.fraction()), 10), least.limit.by,
               least.limit.what);
  }
}

}  // namespace

void print_table(const Suite& suite, const Results& results) {
  print_list(suite, results);
  print_by_instruction_set(suite, results);
  print_limits(suite, results);
  print_targets(suite, results);
  if (!suite.notes().empty()) fmt::print("\n");
  for (const std::string& note : suite.notes()) fmt::print("{}.\n", note);
}

}  // namespace shaftcull::bench
