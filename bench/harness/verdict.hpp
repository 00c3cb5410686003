// SPDX-License-Identifier: MIT
/// What a run says about targets and limits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/results.hpp"
#include "harness/suite.hpp"

namespace shaftcull::bench {

/// What a target's figure came to; nothing if what it needs did not run.
[[nodiscard]] std::optional<double> measured_figure(const Target& target, const Results& results);

/// Whether `figure` is what the target asks for.
[[nodiscard]] bool is_met(const Target& target, double figure);

/// One limit of a path in numbers.
struct Ceiling {
  Limit limit;
  double per_second;  ///< items of the path that the limit allows
};

/// A path that was measured, with its limits: the first allows least, so it is the one that the path meets.
struct PathLimits {
  std::string path;
  double per_second;
  std::vector<Ceiling> ceilings;  ///< at least one, ascending

  [[nodiscard]] double fraction() const { return per_second / ceilings.front().per_second; }
};

/// All paths that were measured together with at least one of their limits, in the order in which they were declared.
[[nodiscard]] std::vector<PathLimits> limits_of_paths(const Suite& suite, const Results& results);

/// Paths below this share of their limit have their reason written down in docs/measurements.md.
inline constexpr double least_fraction = 0.7;

}  // namespace shaftcull::bench
