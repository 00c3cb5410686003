// SPDX-License-Identifier: MIT
/// What `shaftcull factors` found, and what is written of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "facet_job.hpp"
#include "shaftcull/view_factors.hpp"

namespace shaftcull::cli {

struct FactorsResult : FacetResult {
  ViewFactors factors{};

  /// What part of a patch's radiation meets no patch.
  [[nodiscard]] double sky(std::size_t patch) const { return factors.sum[patch] < 1 ? 1 - factors.sum[patch] : 0; }
  [[nodiscard]] std::vector<double> skies() const;
};

/// The factors between objects, by area: row by row, from each object to each.
[[nodiscard]] std::vector<double> factors_of_objects(const FactorsResult& result);

/// The whole report, ended by a newline.
[[nodiscard]] std::string format_report(const FactorsResult& result, ReportFormat format);

/// Throws InvalidArgument for a name that ends neither in .npz nor in .csv, and is no stream.
void require_factors_name(const std::string& path);
/// Writes the matrix: as scipy.sparse.load_npz() reads it, or a line for each factor.
void write_factors(const FactorsResult& result, const std::string& path);
}  // namespace shaftcull::cli
