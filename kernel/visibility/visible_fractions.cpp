// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "parallel/parallel.hpp"
#include "shaftcull/rays.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/sight_rays.hpp"
#include "visibility/visibility_arguments.hpp"

namespace shaftcull {
namespace {

void require_pairs(const UndecidedPairs& pairs, std::size_t a, std::size_t b, std::size_t occluders) {
  if (pairs.first_candidate.size() != pairs.pairs.size() + 1) {
    kernel::fail(InvalidArgument("first_candidate has " + kernel::counted(pairs.first_candidate.size(), "position") +
                                 " for " + kernel::counted(pairs.pairs.size(), "pair") +
                                 "; rays take the candidates of each (VisibilityOptions::candidates)"));
  }
  for (std::size_t i = 0; i != pairs.pairs.size(); ++i) {
    const auto refuse = [&](const std::string& what) {
      kernel::fail(InvalidArgument("pair " + std::to_string(i) + " " + what));
    };
    const PatchPair& pair = pairs.pairs[i];
    if (pair.a >= a || pair.b >= b) {
      refuse("is of patches " + std::to_string(pair.a) + " and " + std::to_string(pair.b) + "; there are " +
             std::to_string(a) + " and " + std::to_string(b));
    }
    if (pairs.first_candidate[i] > pairs.first_candidate[i + 1] ||
        pairs.first_candidate[i + 1] > pairs.candidates.size()) {
      refuse("has candidates that do not lie in `candidates`");
    }
    for (std::size_t c = pairs.first_candidate[i]; c != pairs.first_candidate[i + 1]; ++c) {
      if (pairs.candidates[c] < occluders) continue;
      refuse("has candidate " + std::to_string(pairs.candidates[c]) + "; there are " +
             kernel::counted(occluders, "occluder"));
    }
  }
}

void write_fractions(const PatchSet& a, const PatchSet& b, const Occluders& occluders, const UndecidedPairs& pairs,
                     std::span<float> fractions, const RayOptions& options) {
  kernel::require_rays(options.rays, options.error, options.tolerance);
  if (fractions.size() != pairs.pairs.size()) {
    kernel::fail(InvalidArgument("fractions has " + kernel::counted(fractions.size(), "element") + " for " +
                                 kernel::counted(pairs.pairs.size(), "pair")));
  }
  require_pairs(pairs, a.size(), b.size(), occluders.size());
  if (fractions.empty()) return;
  const kernel::SightRays rays(a.tree(), b.tree(), occluders.data(), options.tolerance, options.rays, options.seed);
  constexpr std::size_t chunk = 64;
  const auto cast = [&](std::size_t row, std::size_t) {
    kernel::in_float_environment([&] {
      for (std::size_t i = row * chunk; i != std::min((row + 1) * chunk, fractions.size()); ++i) {
        const std::size_t first = pairs.first_candidate[i];
        const kernel::RayTally tally = rays.cast(
            pairs.pairs[i], pairs.candidates.subspan(first, pairs.first_candidate[i + 1] - first), options.rays,
            nullptr, [&](const kernel::RayTally& so_far) { return so_far.is_within(options.error); });
        fractions[i] = tally.fraction();
      }
    });
  };
  kernel::parallel_for((fractions.size() + chunk - 1) / chunk, 1, cast);
}

}  // namespace

void visible_fractions(const PatchSet& a, const PatchSet& b, const Occluders& occluders, const UndecidedPairs& pairs,
                       std::span<float> fractions, const RayOptions& options) {
  kernel::in_float_environment([&] { write_fractions(a, b, occluders, pairs, fractions, options); });
}

}  // namespace shaftcull
