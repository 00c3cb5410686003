// SPDX-License-Identifier: MIT
#include "factors_job.hpp"

#include <cstdio>
#include <vector>

namespace shaftcull::cli {

void require_factor_files(const FactorsOptions& options) {
  if (!options.out.empty()) require_factors_name(options.out);
  options.require_files(options.scene.paths);
}

FactorsResult factors_scene(const FactorsOptions& options) {
  FactorsResult result{{make_facet_scene(options.scene, options.objects)}};
  result.most_rays = options.ask.rays;
  result.shows_objects = options.objects;
  return result;
}

ViewFactorOptions factors_question(const FactorsOptions& options, const FactorsResult& result) {
  ViewFactorOptions ask = options.ask;
  ask.seed = options.scene.seed;
  ask.memory = options.megabytes << 20;
  ask.tolerance = result.scene.tolerance;
  return ask;
}

void write_factors(const FactorsResult& result, const FactorsOptions& options) {
  const std::string hint = options.scene.hint_about_normals(result.factors.counts);
  if (!hint.empty()) static_cast<void>(std::fputs(hint.c_str(), stderr));
  if (!options.out.empty()) write_factors(result, options.out);
  const std::vector<double> skies = result.skies();
  const FacetMap sky{skies, 1, "sky", "of the radiation meets no patch", "Sky view factors"};
  write_pictures(result, sky, options);
  print_report(format_report(result, report_format(options.format)), options);
}

}  // namespace shaftcull::cli
