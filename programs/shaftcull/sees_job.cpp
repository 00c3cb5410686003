// SPDX-License-Identifier: MIT
#include "sees_job.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "mesh_files.hpp"
#include "rooms.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull::cli {
namespace {

bool is_output(const std::string& path) { return !path.empty() && is_standard_output(path); }

std::string source_of(const SeesOptions& options) {
  if (options.rooms != 0) return fmt::format("{} room{}", options.rooms, options.rooms == 1 ? "" : "s");
  const std::size_t more = options.paths.size() - 1;
  return options.paths.front() + (more == 0 ? "" : fmt::format(" and {} more file{}", more, more == 1 ? "" : "s"));
}

/// A line about normals that seem to point the wrong way; empty if they do not.
std::string hint_of(const SeesReport& report, const SeesChoice& choice) {
  constexpr double most = 0.9;
  const double share = static_cast<double>(report.counts.sights.facing_away) /
                       static_cast<double>(std::max<std::uint64_t>(report.counts.sights.total(), 1));
  if (choice.two_sided || share <= most) return {};
  return fmt::format(
      "{:.1f} % of the pairs face away. If normals point to the wrong side, {}; with --two-sided patches see on both\n",
      100 * share, choice.flip ? "leave out --flip" : "--flip turns them round");
}

}  // namespace

SeesJob::SeesJob(const SeesOptions& options) : options_(options), source_(source_of(options)) {}

void SeesJob::check() const {
  if ((is_output(options_.out) && is_output(options_.svg)) || (!options_.out.empty() && options_.out == options_.svg)) {
    throw InvalidArgument(
        fmt::format("--out {} --svg {}: one cannot be both; give two files", options_.out, options_.svg));
  }
}

void SeesJob::prepare() {
  scene_.emplace(make_sees_scene(options_.rooms != 0
                                     ? make_rooms(options_.rooms, options_.seed)
                                     : load_mesh_files(options_.paths, {.by_material = options_.by_material}),
                                 options_.choice, source_));
  patches_.emplace(scene_->boxes, scene_->planes);
}

SeesWork SeesJob::work() const { return {options_.content, options_.seed, options_.megabytes << 20, {}, {}}; }

std::span<SightSink* const> SeesJob::open() {
  if (!options_.out.empty()) {
    file_ = sight_file(options_.out, *scene_, patches_->order(), options_.content);
    sinks_.push_back(file_.get());
  }
  if (SeenShares* const shares = open_shares()) sinks_.push_back(shares);
  return sinks_;
}

SeenShares* SeesJob::open_shares() {
  return options_.svg.empty() ? nullptr : &shares_.emplace(patches_->order(), options_.content.rays);
}

std::unique_ptr<OutputFile> SeesJob::open_picture() const {
  return options_.svg.empty() ? nullptr : std::make_unique<OutputFile>(options_.svg);
}

void SeesJob::finish(const SeesReport& report, OutputFile* picture) {
  if (picture != nullptr) {
    picture->write(svg_of_shares(*scene_, *shares_, static_cast<std::size_t>(options_.up[0] - 'x')));
    picture->finish();
  }
  const std::string hint = hint_of(report, options_.choice);
  if (!hint.empty()) static_cast<void>(std::fputs(hint.c_str(), stderr));
  // Where a file is standard output, the report goes elsewhere.
  const bool is_taken = is_output(options_.out) || is_output(options_.svg);
  std::fputs(format_report(report, report_format(options_.format)).c_str(), is_taken ? stderr : stdout);
}

SeesReport report_of(const SeesScene& scene, const SeesWork& work, const std::string& source) {
  return {source,
          std::string(name(active_isa())),
          scene.mesh.names.size(),
          scene.mesh.triangles.size(),
          scene.patches.size(),
          scene.patch_size,
          scene.occluders.size(),
          scene.solids,
          work.content.rays,
          {},
          0,
          concurrency(),
          1,
          0};
}

}  // namespace shaftcull::cli
