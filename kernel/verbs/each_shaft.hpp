// SPDX-License-Identifier: MIT
/// Loops over shafts, in parallel.
#pragma once

#include <cstddef>

#include "parallel/parallel.hpp"
#include "support/index_range.hpp"
#include "verbs/asked.hpp"

namespace shaftcull::kernel {

/// Shafts in a task of walks: tens to hundreds of microseconds.
inline constexpr std::size_t task_walks = 16;

/// Calls use(s), which walks or scans, for every shaft of a query, in parallel.
template <class Use>
void for_each_shaft(const Asked& asked, const Use& use) {
  const std::size_t shafts = asked.shafts().size();
  const std::size_t each = asked.walks() != nullptr ? task_walks : 1;
  parallel_for(chunk_count(shafts, each), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(shafts, each, t);
    for (std::size_t s = task.first; s != task.end(); ++s) use(s);
  });
}

}  // namespace shaftcull::kernel
