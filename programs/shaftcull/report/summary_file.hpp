// SPDX-License-Identifier: MIT
/// build/bench/summary.json, as `shaftcull-bench` writes it (bench/harness/summary.hpp), read back.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shaftcull::cli {

struct Cache {
  int level;
  std::string type;  ///< Data, Instruction or Unified
  double bytes;
};

/// What a benchmark came to.
struct Speed {
  double per_second;
  std::optional<double> vs_paper;
};

/// A figure to be reached.
struct ReachRow {
  std::string row;
  std::string against;  ///< empty for a time
  std::optional<double> value;
  double target;
  bool is_time;  ///< nanoseconds, else a ratio
  bool at_most;  ///< lower is better
  bool met;

  /// 1 or more where the target is met, else how much of it: 0.9 for nine tenths. Nothing if it was not measured.
  [[nodiscard]] std::optional<double> share_of_target() const {
    if (!value) return std::nullopt;
    return at_most ? target / *value : *value / target;
  }
};

/// What a limit allows a path.
struct PathCeiling {
  std::string by;
  std::string what;
  double per_second;
};

struct PathLimit {
  std::string row;
  double per_second;
  double fraction;  ///< of the first ceiling
  std::vector<PathCeiling> ceilings;
};

struct BenchSummary {
  std::string cpu;
  std::string compiler;
  std::string date;
  std::size_t cores;
  std::optional<double> load;  ///< processes that wanted to run in the minute before measuring began
  std::vector<std::string> isas;
  std::vector<Cache> caches;
  bool quick;
  double bounds;
  double shafts;
  std::map<std::string, Speed> results;
  std::vector<ReachRow> reach;
  std::vector<PathLimit> limits;

  /// Speed of the benchmark of that name; nothing if it was not measured.
  [[nodiscard]] std::optional<double> speed(const std::string& name) const;
};

/// Throws InvalidArgument, which names the file, the line and what is wrong there, if it cannot be read, is not JSON,
/// lacks a part of what the benchmark writes, or has no results.
[[nodiscard]] BenchSummary read_summary(const std::string& path);

}  // namespace shaftcull::cli
