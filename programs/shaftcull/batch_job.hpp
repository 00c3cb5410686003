// SPDX-License-Identifier: MIT
/// What `shaftcull batch` runs, in builds that can and in others.
#pragma once

#include <functional>

#include "batch/job.hpp"

namespace shaftcull::cli {

/// Runs a job on all ranks that were launched, with so many threads each, and prints what came of it on the first.
/// Before that, each rank calls `check`, which throws for options that cannot be used. Throws InvalidArgument in a
/// build without HDF5 or xxHash; EarlyExit for input that cannot be used, and where another rank tells why all end.
void run_batch_job(const batch::Job& job, int threads, const std::function<void()>& check);

}  // namespace shaftcull::cli
