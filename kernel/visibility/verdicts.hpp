// SPDX-License-Identifier: MIT
/// The user's verdicts on undecided pairs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/visibility.hpp"
#include "visibility/callers_modes.hpp"
#include "visibility/sight_job.hpp"

namespace shaftcull::kernel {

/// The undecided pairs among some answers, as users see them.
[[nodiscard]] UndecidedPairs undecided_of(const SightJob& job, const SightAnswers& answers) noexcept;

/// Asks VisibilityOptions::resolve, if there is one, about undecided pairs.
class Verdicts {
 public:
  Verdicts(const VisibilityOptions& options, const SightJob& job, const CallersModes& modes);

  /// Makes products of the pairs that have an answer now. Throws InvalidArgument for a verdict that is no Sight.
  void resolve(SightAnswers& answers) const;

 private:
  void apply(std::span<const Sight> verdict, SightAnswers& answers) const;

  const VisibilityOptions& options_;
  const SightJob& job_;
  const CallersModes& modes_;
  // Where in the order of its tree each patch is.
  std::vector<std::uint32_t> a_place_;
  std::vector<std::uint32_t> b_place_;
};

}  // namespace shaftcull::kernel
