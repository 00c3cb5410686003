// SPDX-License-Identifier: MIT
/// What `shaftcull factors` found, and what is written of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "factor_patches.hpp"
#include "output_file.hpp"
#include "report_format.hpp"
#include "sees_scene.hpp"
#include "shaftcull/view_factors.hpp"

namespace shaftcull::cli {

struct FactorsResult {
  std::string source;  ///< the file, or which rooms
  SeesScene scene;
  FactorPatches patches;
  ViewFactors factors;
  double patch_size = 0;  ///< 0: facets are whole
  std::uint32_t most_rays = 0;
  double seconds = 0;
  int threads = 0;
  std::uint64_t memory = 0;  ///< the most bytes that the program had
  bool shows_objects = false;

  [[nodiscard]] std::uint32_t object_of(std::size_t patch) const {
    return scene.mesh.triangles[patches.triangle[patch]].object;
  }
  /// The number, within the object, of the first triangle that the patch is of.
  [[nodiscard]] std::uint32_t triangle_of(std::size_t patch) const {
    return scene.mesh.triangles[patches.triangle[patch]].triangle;
  }
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
/// Writes an SVG picture of the scene from above, or a PLY file of all patches, in the colours of their sky.
void write_sky_svg(const FactorsResult& result, const std::string& path, std::size_t up);
void write_sky_ply(const FactorsResult& result, const std::string& path);

}  // namespace shaftcull::cli
