// SPDX-License-Identifier: MIT
#include "sun_job.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "printable.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t positions_of_part = 8;

std::span<const SunPosition> positions_in(const SunResult& result, std::size_t part) {
  const std::span<const SunPosition> all = result.positions;
  const std::size_t first = part * positions_of_part;
  return all.subspan(first, std::min(positions_of_part, all.size() - first));
}

/// Rays are drawn in both their coordinates together, so a share that is neither 0 nor 1 is known at least as well as
/// from rays at random.
double variance_of(double share, const SunOptions& options, std::uint32_t most_rays) {
  const double spread = share * (1 - share);
  const double error = options.ask.error;
  return std::min(std::max(spread / most_rays, error * error), spread / 16);  // 16 rays are cast in any case
}

void set_positions(SunResult& result, const SunOptions& options) {
  if (!options.directions.empty()) {
    result.positions = read_sun_positions(options.directions);
    result.where = "from " + printable(options.directions);
    return;
  }
  if (options.day.empty()) {
    throw InvalidArgument(
        "sun: no position of the sun is given; add --latitude DEGREES and --day MM-DD, or --directions FILE");
  }
  result.positions = sun_path(options.latitude, day_of_year(options.day), options.minutes, options.up[0]);
  result.where = fmt::format("latitude {}, {}, every {:.4g} min", options.latitude, printable(options.day),
                             sun_step(options.minutes));
}

}  // namespace

void require_sun_files(const SunOptions& options) {
  if (!options.out.empty()) require_sun_name(options.out);
  std::vector<std::string> read = options.scene.paths;
  if (!options.directions.empty()) read.push_back(options.directions);
  options.require_files(read);
}

SunResult sun_scene(const SunOptions& options) {
  SceneOptions scene = options.scene;
  scene.choice.finds_solids = false;  // rays meet the triangles themselves
  SunResult result{{make_facet_scene(scene, options.objects)}};
  set_positions(result, options);
  set_normals(result);
  result.most_rays = (options.ask.rays + 15) / 16 * 16;
  result.shows_objects = options.objects;
  result.hours.resize(result.patches.size());
  result.variance.resize(result.patches.size());
  return result;
}

std::size_t sun_parts(const SunResult& result) noexcept {
  return (result.positions.size() + positions_of_part - 1) / positions_of_part;
}

std::vector<float> lit_by(const SunResult& result, const PatchSet& patches, std::size_t part,
                          const SunOptions& options) {
  std::vector<Vec3> lights;
  for (const SunPosition& position : positions_in(result, part)) lights.push_back(position.towards);
  RayOptions ask = options.ask;
  ask.tolerance = result.scene.tolerance;
  ask.seed = options.scene.seed + part * positions_of_part;
  std::vector<float> lit(patches.size() * lights.size());
  lit_fractions(patches, result.scene.occluders, lights, lit, ask);
  return lit;
}

void add_lit(SunResult& result, std::size_t part, std::span<const float> lit, const SunOptions& options) {
  const std::span<const SunPosition> positions = positions_in(result, part);
  if (part == 0 && !options.out.empty()) result.lit.resize(result.patches.size() * result.positions.size());
  for (std::size_t i = 0; i != result.patches.size(); ++i) {
    const std::span<const float> row = lit.subspan(i * positions.size(), positions.size());
    for (std::size_t j = 0; j != positions.size(); ++j) {
      const double hours = positions[j].hours;
      result.hours[i] += double{row[j]} * hours;
      result.variance[i] += hours * hours * variance_of(row[j], options, result.most_rays);
    }
    if (result.lit.empty()) continue;
    std::ranges::copy(
        row, result.lit.begin() + static_cast<std::ptrdiff_t>(i * result.positions.size() + part * positions_of_part));
  }
}

void write_sun(const SunResult& result, const SunOptions& options) {
  if (!options.out.empty()) write_sun(result, options.out);
  const std::string words = fmt::format("of {:.2f} h of sun", result.daylight());
  write_pictures(result, {result.hours, result.daylight(), "sun", words.c_str(), "Hours of sun"}, options);
  print_report(format_report(result, report_format(options.format)), options);
}

}  // namespace shaftcull::cli
