// SPDX-License-Identifier: MIT
/// One of the two sets that are compared, with what is known of its planes.
#pragma once

#include <vector>

#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {

/// Patches, and the errors of computed distances from their planes: of each patch's, and of each group's.
struct SightSet {
  const PatchTree& tree;
  std::vector<float> patch_error;
  std::vector<float> group_error;
};

/// The set, for points with coordinates of at most `coordinate`. Any floating-point modes. O(n).
[[nodiscard]] SightSet sight_set(const PatchTree& tree, float coordinate);

}  // namespace shaftcull::kernel
