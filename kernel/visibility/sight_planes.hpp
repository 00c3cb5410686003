// SPDX-License-Identifier: MIT
/// Planes of patches and groups, as lanes read them.
#pragma once

#include <array>
#include <vector>

namespace shaftcull::kernel {

/// For patches, or for groups: offsets of planes with the tolerance in them, and errors of computed distances from
/// them.
struct PlaneLimits {
  std::vector<float> offset;
  std::vector<float> error;
};

/// Planes of patches that are seen from both sides, facing the other way than those of the tree.
struct ReversedPlanes {
  std::array<std::vector<float>, 3> normal;
  PlaneLimits limits;
};

struct SightPlanes {
  PlaneLimits patches;
  ReversedPlanes reversed;
  PlaneLimits groups;
};

/// The values that the planes depend on, besides the tree.
struct SightKey {
  float tolerance = 0;
  float coordinate = 0;  ///< the largest magnitude in the job

  bool operator==(const SightKey&) const noexcept = default;
};

}  // namespace shaftcull::kernel
