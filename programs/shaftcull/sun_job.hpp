// SPDX-License-Identifier: MIT
/// What a run of `shaftcull sun` is given, computes and writes, on one process or on many.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shaftcull/rays.hpp"
#include "sun_result.hpp"

namespace shaftcull::cli {

struct SunOptions : FacetOptions {
  RayOptions ask;
  double latitude = 0;
  std::string day;
  double minutes = 15;
  std::string directions;
};

/// Throws InvalidArgument for files that cannot all be written.
void require_sun_files(const SunOptions& options);

/// The scene and the positions of the sun, without hours.
[[nodiscard]] SunResult sun_scene(const SunOptions& options);

/// The number of parts, of some positions each. It depends on the number of positions alone.
[[nodiscard]] std::size_t sun_parts(const SunResult& result) noexcept;

/// The lit fraction of each patch at each position of a part, row by row for all of these positions.
[[nodiscard]] std::vector<float> lit_by(const SunResult& result, const PatchSet& patches, std::size_t part,
                                        const SunOptions& options);

/// Adds the answer of a part to the hours. Parts are added in their order, so that sums are the same bits.
void add_lit(SunResult& result, std::size_t part, std::span<const float> lit, const SunOptions& options);

/// Writes the files, and prints the report.
void write_sun(const SunResult& result, const SunOptions& options);

}  // namespace shaftcull::cli
