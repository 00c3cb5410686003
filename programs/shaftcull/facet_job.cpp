// SPDX-License-Identifier: MIT
#include "facet_job.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "output_file.hpp"
#include "table.hpp"

namespace shaftcull::cli {

std::string FacetOptions::kept_beside() const {
  for (const std::string& path : {out, svg, ply}) {
    if (!path.empty() && !is_stream(path)) return path;
  }
  return {};
}

void FacetOptions::require_files(const std::vector<std::string>& read) const {
  require_different_files({{"--out", out}, {"--svg", svg}, {"--ply", ply}}, read);
}

std::string FacetResult::spent(const char* what) const {
  return fmt::format("\n{:.2f} s, {} thread{}{}, at most {} ray{} per {}, {} MB of memory\n", seconds, threads,
                     threads == 1 ? "" : "s", ranks == 1 ? "" : fmt::format(" on {} ranks", ranks), grouped(most_rays),
                     most_rays == 1 ? "" : "s", what, grouped((memory + 999'999) / 1'000'000));
}

void write_pictures(const FacetScene& scene, const FacetMap& map, const FacetOptions& options) {
  if (!options.svg.empty()) write_map_svg(scene, map, options.svg, static_cast<std::size_t>(options.up[0] - 'x'));
  if (!options.ply.empty()) write_map_ply(scene, map, options.ply);
}

void print_report(const std::string& report, const FacetOptions& options) {
  // Where a file is standard output, the report goes elsewhere.
  bool is_taken = false;
  for (const std::string& path : {options.out, options.svg, options.ply}) {
    is_taken = is_taken || (!path.empty() && is_standard_output(path));
  }
  std::fputs(report.c_str(), is_taken ? stderr : stdout);
}

}  // namespace shaftcull::cli
