// SPDX-License-Identifier: MIT
/// `shaftcull factors` and `sun` in parts that several processes share, and that are kept until all are there.
#pragma once

#include <optional>

#include "factors_job.hpp"
#include "sun_job.hpp"

namespace shaftcull::cli {

/// Whether this build has HDF5 and xxHash, which jobs in parts need.
[[nodiscard]] bool can_keep_parts() noexcept;

/// Each does its job in parts, as run_facet_parts() says. `scene` is the result of factors_scene() or sun_scene(), if
/// the caller has it. Throws InvalidArgument in a build without HDF5 or xxHash.
void run_factors_in_parts(const FactorsOptions& options, std::optional<FactorsResult>&& scene = {});
void run_sun_in_parts(const SunOptions& options, std::optional<SunResult>&& scene = {});

}  // namespace shaftcull::cli
