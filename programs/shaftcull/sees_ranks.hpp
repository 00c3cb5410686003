// SPDX-License-Identifier: MIT
/// `shaftcull sees` on several processes, in builds that can and in others.
#pragma once

#include "sees_job.hpp"

namespace shaftcull::cli {

/// All ranks that were launched do a job: parts of its patches are dealt to whoever is free, and are kept in the folder
/// FILE.parts/ until all are there; then ranks write them to their places in the file, which does not depend on the
/// number of ranks, and the first one draws the picture. A job that was ended is gone on with. Without a file nothing
/// is kept, and counts alone are added. Throws EarlyExit when one rank has told what cannot be used; InvalidArgument in
/// a build without HDF5 or xxHash.
void run_on_launched_ranks(SeesJob& job);

}  // namespace shaftcull::cli
