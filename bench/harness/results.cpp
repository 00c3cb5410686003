// SPDX-License-Identifier: MIT
#include "harness/results.hpp"

#include <algorithm>
#include <cstddef>

namespace shaftcull::bench {

void Results::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.error_occurred) errors_.insert(run.run_name.function_name + ": " + run.error_message);
    const auto speed = run.counters.find("items_per_second");
    if (run.run_type != Run::RT_Iteration || speed == run.counters.end()) continue;
    speeds_[run.run_name.function_name].push_back(speed->second.value);
  }
}

std::optional<double> Results::per_second(const std::string& name) const {
  const auto found = speeds_.find(name);
  if (found == speeds_.end()) return std::nullopt;
  std::vector<double> speeds = found->second;
  std::sort(speeds.begin(), speeds.end());
  const std::size_t middle = speeds.size() / 2;
  return speeds.size() % 2 == 1 ? speeds[middle] : 0.5 * (speeds[middle - 1] + speeds[middle]);
}

std::optional<double> Results::ratio(const std::string& name, const std::string& against) const {
  const std::optional<double> speed = per_second(name);
  const std::optional<double> base = per_second(against);
  if (!speed || !base || *base <= 0.0) return std::nullopt;
  return *speed / *base;
}

}  // namespace shaftcull::bench
