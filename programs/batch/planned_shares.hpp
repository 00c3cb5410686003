// SPDX-License-Identifier: MIT
/// The shares of a job, as ranks agree on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "batch/bounds_source.hpp"
#include "batch/dealing.hpp"
#include "batch/ranks.hpp"
#include "batch/share_plan.hpp"

namespace shaftcull::batch {

/// Into which shares bounds are dealt, and how many each has.
struct PlannedShares {
  SharePlan cuts;
  std::vector<std::uint64_t> sizes;    ///< of each share
  std::uint64_t bounds_a_stretch = 0;  ///< of the file, which are dealt at once: at most 2²⁴, no more than a share has

  [[nodiscard]] std::size_t count() const noexcept { return sizes.size(); }
};

/// All: one share if its tree takes no more than `memory` bytes while it is built, or if that is 0 and a tree can hold
/// all; else as few as may be that each take no more. The same for any number of ranks; two plans of as many shares are
/// equal. A pass over the bounds, or
/// several, if there is more than one share. Throws as on_all() does: InvalidArgument if there would be more than
/// 10,000 shares, or more than bounds.
[[nodiscard]] PlannedShares plan_shares(const BoundsSource& bounds, std::uint64_t memory, Ranks& ranks,
                                        const Surroundings& surroundings);

}  // namespace shaftcull::batch
