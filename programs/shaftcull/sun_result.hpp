// SPDX-License-Identifier: MIT
/// What `shaftcull sun` found, and what is written of it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "facet_job.hpp"
#include "sun_path.hpp"

namespace shaftcull::cli {

struct SunResult : FacetResult {
  std::vector<SunPosition> positions{};
  std::string where{};             ///< the positions come from
  std::vector<double> area{};      ///< of each patch
  std::vector<Vec3> normals{};     ///< likewise, of length 1; 0 without an area
  std::vector<double> hours{};     ///< of sun on each patch, in the mean over it
  std::vector<double> variance{};  ///< of these at most, from the number of rays
  std::vector<float> lit{};        ///< the share of each patch that is lit, row by row for all positions; if it is kept

  /// Hours of all positions.
  [[nodiscard]] double daylight() const;
  /// The standard error of the hours of each patch, at most.
  [[nodiscard]] std::vector<double> errors() const;
};

/// Sets the area and the normal of each patch.
void set_normals(SunResult& result);

/// The whole report, ended by a newline.
[[nodiscard]] std::string format_report(const SunResult& result, ReportFormat format);

/// Throws InvalidArgument for a name that does not end in .npz.
void require_sun_name(const std::string& path);
/// Writes hours, and what is lit when, for NumPy.
void write_sun(const SunResult& result, const std::string& path);

}  // namespace shaftcull::cli
