// SPDX-License-Identifier: MIT
/// Visible fractions of pairs that have all occluders as candidates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shaftcull/rays.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull {

inline std::vector<float> fractions_of(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                                       const std::vector<PatchPair>& pairs, const RayOptions& options = {}) {
  std::vector<std::size_t> first{0};
  std::vector<std::uint32_t> candidates;
  for (std::size_t i = 0; i != pairs.size(); ++i) {
    for (std::uint32_t c = 0; c != occluders.size(); ++c) candidates.push_back(c);
    first.push_back(candidates.size());
  }
  std::vector<float> fractions(pairs.size());
  visible_fractions(a, b, occluders, {pairs, first, candidates}, fractions, options);
  return fractions;
}

}  // namespace shaftcull
