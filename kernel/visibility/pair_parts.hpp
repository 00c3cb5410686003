// SPDX-License-Identifier: MIT
/// Divides all pairs of a call into parts, so that processes can share them.
#pragma once

#include <cstdint>
#include <vector>

#include "visibility/sight_job.hpp"

namespace shaftcull::kernel {

/// All pairs of a patch of one group and a patch of another.
struct GroupPair {
  std::uint32_t a;
  std::uint32_t b;
};

/// Returns the pairs of groups that make up a part, in order. `part` is below `parts`. Each pair of patches is in
/// exactly one part, and parts have three to five quarters of an equal share, or 4,096 pairs more or less. If there are
/// few pairs, parts may be empty. The walk enters only pairs of groups that overlap the part.
[[nodiscard]] std::vector<GroupPair> groups_of_part(const SightJob& job, std::uint32_t part, std::uint32_t parts);

}  // namespace shaftcull::kernel
