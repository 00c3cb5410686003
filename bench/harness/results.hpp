// SPDX-License-Identifier: MIT
/// What the benchmarks measured: one speed for each name.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "harness/suite.hpp"

namespace shaftcull::bench {

/// Collects the items per second of all repetitions as Google Benchmark reports them.
class Results : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;

  /// What benchmarks said that could not be measured, each with its name.
  [[nodiscard]] const std::set<std::string>& errors() const noexcept { return errors_; }

  /// The median over all repetitions; nothing if the benchmark did not run.
  [[nodiscard]] std::optional<double> per_second(const std::string& name) const;
  /// per_second(name) over per_second(against); nothing if either did not run.
  [[nodiscard]] std::optional<double> ratio(const std::string& name, const std::string& against) const;

 private:
  std::map<std::string, std::vector<double>> speeds_;
  std::set<std::string> errors_;  // once, whatever the number of repetitions
};

}  // namespace shaftcull::bench
