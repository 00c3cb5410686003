// SPDX-License-Identifier: MIT
#include "harness/verdict.hpp"

#include <algorithm>

namespace shaftcull::bench {

std::optional<double> measured_figure(const Target& target, const Results& results) {
  if (target.kind == Target::Kind::speed_ratio) return results.ratio(target.measured, target.against);
  if (target.kind == Target::Kind::time_ratio) return results.ratio(target.against, target.measured);
  const std::optional<double> speed = results.per_second(target.measured);
  if (!speed || *speed <= 0) return std::nullopt;
  return 1e9 / *speed;
}

bool is_met(const Target& target, double figure) {
  return target.at_most() ? figure <= target.figure : figure >= target.figure;
}

std::vector<PathLimits> limits_of_paths(const Suite& suite, const Results& results) {
  std::vector<PathLimits> paths;
  for (const Limit& limit : suite.limits()) {
    const std::optional<double> speed = results.per_second(limit.path);
    const std::optional<double> rate = results.per_second(limit.by);
    if (!speed || !rate) continue;
    auto path =
        std::find_if(paths.begin(), paths.end(), [&](const PathLimits& each) { return each.path == limit.path; });
    if (path == paths.end()) path = paths.insert(paths.end(), {limit.path, *speed, {}});
    path->ceilings.push_back({limit, *rate / limit.units});
  }
  for (PathLimits& path : paths) {
    std::stable_sort(path.ceilings.begin(), path.ceilings.end(),
                     [](const Ceiling& a, const Ceiling& b) { return a.per_second < b.per_second; });
  }
  return paths;
}

}  // namespace shaftcull::bench
