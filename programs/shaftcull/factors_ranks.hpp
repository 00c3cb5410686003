// SPDX-License-Identifier: MIT
/// `shaftcull factors` in parts that several processes share, and that are kept until all are there.
#pragma once

#include <optional>

#include "factors_job.hpp"

namespace shaftcull::cli {

/// Finds factors on all launched ranks, or in this process if none were launched. A free rank takes the next part of
/// all pairs, and stores its factors in FILE.parts/, where FILE is the argument of --out. Then the first rank joins all
/// parts and writes the files, which do not depend on the number of ranks. Resumes a job that was interrupted. Throws
/// EarlyExit after one rank has reported an unusable argument, and InvalidArgument in a build without HDF5 or xxHash.
/// `scene` is the result of factors_scene(), if the caller has it.
void run_factors_in_parts(const FactorsOptions& options, std::optional<FactorsResult>&& scene = {});

/// Whether this build has HDF5 and xxHash, which run_factors_in_parts() needs.
[[nodiscard]] bool can_find_factors_in_parts() noexcept;

}  // namespace shaftcull::cli
