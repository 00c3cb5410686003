// SPDX-License-Identifier: MIT
/// What a run of `shaftcull sees` is given, reads and writes, on one process or on many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "facet_job.hpp"
#include "output_file.hpp"
#include "sees_report.hpp"
#include "sees_run.hpp"

namespace shaftcull::cli {

struct SeesOptions : FacetOptions {
  SightContent content;
  std::size_t megabytes = 256;
};

/// Null if they are not wanted.
struct SeesPictures {
  std::unique_ptr<OutputFile> svg;
  std::unique_ptr<OutputFile> ply;
};

class SeesJob {
 public:
  explicit SeesJob(const SeesOptions& options);

  /// Makes the scene. The same on every process.
  void prepare();

  [[nodiscard]] const SeesOptions& options() const noexcept { return options_; }
  [[nodiscard]] const std::string& source() const noexcept { return source_; }
  [[nodiscard]] const SeesScene& scene() const { return *scene_; }
  [[nodiscard]] const PatchSet& patches() const { return *patches_; }
  [[nodiscard]] SeesWork work() const;

  /// Opens the file of answers that is to be written; answers go to these sinks. For one process that has all answers.
  [[nodiscard]] std::span<SightSink* const> open();
  /// What pictures and the report show besides counts of all pairs. For several processes, of which each takes some
  /// answers.
  [[nodiscard]] std::span<SummingSink* const> open_sums();
  /// Opens the pictures that are wanted. To be called by the process that finishes.
  [[nodiscard]] SeesPictures open_pictures() const;
  /// Draws the pictures, and prints the report.
  void finish(SeesReport report, const SeesPictures& pictures);

 private:
  const SeesOptions& options_;
  std::string source_;  ///< what messages call the scene
  std::optional<SeesScene> scene_;
  std::optional<PatchSet> patches_;
  std::vector<SightSink*> sinks_;
  std::unique_ptr<SightSink> file_;
  std::vector<SummingSink*> sums_;
  std::optional<SeenShares> shares_;
  std::optional<ObjectSights> objects_;
};

/// What is known of a run before it is asked.
[[nodiscard]] SeesReport report_of(const SeesScene& scene, const SeesWork& work, const std::string& source);

}  // namespace shaftcull::cli
