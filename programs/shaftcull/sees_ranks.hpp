// SPDX-License-Identifier: MIT
/// `shaftcull sees` on several processes, in builds that can and in others.
#pragma once

#include "sees_job.hpp"

namespace shaftcull::cli {

/// All ranks that were launched do a job. Its pairs are divided into parts. A free rank takes the next part, and stores
/// its answers in the folder FILE.parts/. When all are there, ranks write them to their places in the file, which does
/// not depend on the number of ranks, and the first one draws the pictures. Resumes a job that was interrupted. Without
/// a file nothing is stored, and counts alone are added. Throws EarlyExit after one rank has reported an unusable
/// argument, and InvalidArgument in a build without HDF5 or xxHash.
void run_on_launched_ranks(SeesJob& job);

}  // namespace shaftcull::cli
