// SPDX-License-Identifier: MIT
/// `shaftcull factors` in parts that several processes share, and that are kept until all are there.
#pragma once

#include <optional>

#include "factors_job.hpp"

namespace shaftcull::cli {

/// All ranks that were launched, one if none were, find factors: parts of all pairs are dealt to whoever is free, and
/// are kept in the folder FILE.parts/, where FILE is what --out names. Then the first rank joins them, and writes the
/// files, which do not depend on the number of ranks. A job that was ended is gone on with. Throws EarlyExit when one
/// rank has told what cannot be used; InvalidArgument in a build without HDF5 or xxHash. `scene` is what
/// factors_scene() made of the options, if it was called.
void run_factors_in_parts(const FactorsOptions& options, std::optional<FactorsResult> scene = {});

/// Whether this build can.
[[nodiscard]] bool can_find_factors_in_parts() noexcept;

}  // namespace shaftcull::cli
