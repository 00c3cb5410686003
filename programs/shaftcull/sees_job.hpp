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

#include "instruction_set.hpp"
#include "output_file.hpp"
#include "scene_options.hpp"
#include "sees_report.hpp"
#include "sees_run.hpp"

namespace shaftcull::cli {

struct SeesOptions {
  SceneOptions scene;
  SightContent content;
  std::size_t megabytes = 256;
  std::string out;
  std::string svg;
  std::string ply;
  bool objects = false;  ///< what objects see of each other is reported
  std::string up = "z";
  std::string format = "text";
  int threads = 0;
  InstructionSet isa;
};

/// Null if they are not wanted.
struct SeesPictures {
  std::unique_ptr<OutputFile> svg;
  std::unique_ptr<OutputFile> ply;
};

class SeesJob {
 public:
  explicit SeesJob(const SeesOptions& options);

  /// Throws InvalidArgument for files that cannot all be written.
  void check() const;
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
