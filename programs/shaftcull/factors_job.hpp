// SPDX-License-Identifier: MIT
/// What a run of `shaftcull factors` is given, reads and writes, on one process or on many.
#pragma once

#include <cstddef>

#include "factors_result.hpp"
#include "shaftcull/view_factors.hpp"

namespace shaftcull::cli {

struct FactorsOptions : FacetOptions {
  ViewFactorOptions ask;
  std::size_t megabytes = 256;
};

/// Throws InvalidArgument for files that cannot all be written.
void require_factor_files(const FactorsOptions& options);

/// The scene, without factors.
[[nodiscard]] FactorsResult factors_scene(const FactorsOptions& options);

/// What the library is asked, without a progress callback.
[[nodiscard]] ViewFactorOptions factors_question(const FactorsOptions& options, const FactorsResult& result);

/// Writes the files, and prints the report.
void write_factors(const FactorsResult& result, const FactorsOptions& options);

}  // namespace shaftcull::cli
