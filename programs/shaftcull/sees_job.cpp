// SPDX-License-Identifier: MIT
#include "sees_job.hpp"

#include <cstdio>
#include <memory>

#include "shaftcull/shaftcull.hpp"

namespace shaftcull::cli {

SeesJob::SeesJob(const SeesOptions& options) : options_(options), source_(options.scene.source()) {}

void SeesJob::prepare() {
  scene_.emplace(make_sees_scene(options_.scene.load(), options_.scene.choice, source_));
  patches_.emplace(scene_->patch_set());
}

SeesWork SeesJob::work() const { return {options_.content, options_.scene.seed, options_.megabytes << 20, {}, {}}; }

std::span<SightSink* const> SeesJob::open() {
  if (!options_.out.empty()) {
    file_ = sight_file(options_.out, *scene_, patches_->order(), options_.content);
    sinks_.push_back(file_.get());
  }
  for (SummingSink* const sums : open_sums()) sinks_.push_back(sums);
  return sinks_;
}

std::span<SummingSink* const> SeesJob::open_sums() {
  const std::uint32_t rays = options_.content.rays;
  if (!options_.svg.empty() || !options_.ply.empty()) sums_.push_back(&shares_.emplace(patches_->order(), rays));
  if (options_.objects) sums_.push_back(&objects_.emplace(*scene_, patches_->order(), rays));
  return sums_;
}

SeesPictures SeesJob::open_pictures() const {
  const auto opened = [](const std::string& path) {
    return path.empty() ? nullptr : std::make_unique<OutputFile>(path);
  };
  return {opened(options_.svg), opened(options_.ply)};
}

void SeesJob::finish(SeesReport report, const SeesPictures& pictures) {
  if (pictures.svg) {
    pictures.svg->write(svg_of_shares(*scene_, *shares_, static_cast<std::size_t>(options_.up[0] - 'x')));
    pictures.svg->finish();
  }
  if (pictures.ply) {
    write_ply(*scene_, *shares_, *pictures.ply);
    pictures.ply->finish();
  }
  if (objects_) report.object_pairs = objects_->pairs();
  const std::string hint = options_.scene.hint_about_normals(report.counts.sights);
  if (!hint.empty()) static_cast<void>(std::fputs(hint.c_str(), stderr));
  print_report(format_report(report, report_format(options_.format)), options_);
}

SeesReport report_of(const SeesScene& scene, const SeesWork& work, const std::string& source) {
  return {source,
          std::string(name(active_isa())),
          scene.mesh.names.size(),
          scene.mesh.triangles.size(),
          scene.patches.size(),
          scene.patch_size,
          scene.tolerance,
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
