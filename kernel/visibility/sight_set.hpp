// SPDX-License-Identifier: MIT
/// One of the two sets that are compared, with what is known of its planes.
#pragma once

#include <vector>

#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {

/// For patches, or for groups: offsets of planes with the tolerance in them, and errors of computed distances from
/// them.
struct PlaneLimits {
  std::vector<float> offset;
  std::vector<float> error;
};

/// Planes of patches that are seen from both sides, facing the other way than those of the tree.
struct ReversedPlanes {
  std::vector<float> normal[3];
  PlaneLimits limits;
};

struct SightSet {
  const PatchTree& tree;
  float tolerance;
  float coordinate;  ///< the largest magnitude in the job
  PlaneLimits patches;
  ReversedPlanes reversed;
  PlaneLimits groups;
};

/// The set, for points with coordinates of at most `coordinate`. Any floating-point modes. O(n).
[[nodiscard]] SightSet sight_set(const PatchTree& tree, float tolerance, float coordinate);

}  // namespace shaftcull::kernel
