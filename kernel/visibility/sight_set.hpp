// SPDX-License-Identifier: MIT
/// One of the two sets that are compared, with what is known of its planes.
#pragma once

#include <memory>

#include "visibility/patch_tree.hpp"
#include "visibility/sight_planes.hpp"

namespace shaftcull::kernel {

struct SightSet {
  const PatchTree& tree;
  float tolerance;
  float coordinate;  ///< the largest magnitude in the job
  std::shared_ptr<const SightPlanes> planes;
};

/// The set, for points with coordinates of at most `coordinate`. Any floating-point modes. O(n); O(1) if the last call
/// for this tree had the same tolerance and coordinate.
[[nodiscard]] SightSet sight_set(const PatchTree& tree, float tolerance, float coordinate);

}  // namespace shaftcull::kernel
