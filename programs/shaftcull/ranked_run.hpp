// SPDX-License-Identifier: MIT
/// Runs of several processes that a launcher started.
#pragma once

#include <functional>

#include "batch/dealing.hpp"
#include "batch/ranks.hpp"

namespace shaftcull::cli {

/// Does `work` on all ranks that were launched, one if none were, with so many threads each. Before that, each rank
/// calls `check`, which throws for options that cannot be used. Throws EarlyExit for what `work` throws, after one rank
/// has told why, and where another rank tells it. A launcher may then kill ranks that are slow to end, so what a failed
/// job must not leave behind belongs to `work`.
void run_on_ranks(int threads, const std::function<void()>& check,
                  const std::function<void(batch::Ranks&, const batch::Surroundings&)>& work);

}  // namespace shaftcull::cli
