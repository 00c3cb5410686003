// SPDX-License-Identifier: MIT
/// Parts of all pairs of a call, for processes that answer some each.
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

/// The groups that a part consists of, in order. `part` is below `parts`. Every pair is in one part, and parts have
/// about as many pairs each; where there are few pairs, parts may be empty. O(parts) at worst.
[[nodiscard]] std::vector<GroupPair> groups_of_part(const SightJob& job, std::uint32_t part, std::uint32_t parts);

}  // namespace shaftcull::kernel
