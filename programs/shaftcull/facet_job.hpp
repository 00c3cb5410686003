// SPDX-License-Identifier: MIT
/// What `factors` and `sun` share: options, files and reports of a job on the facets of a mesh. `sees` has these
/// options, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "facet_scene.hpp"
#include "instruction_set.hpp"
#include "report_format.hpp"
#include "scene_options.hpp"

namespace shaftcull::cli {

struct FacetOptions {
  SceneOptions scene;
  std::string out;
  std::string svg;
  std::string ply;
  bool objects = false;  ///< objects are reported, too
  std::string up = "z";
  std::string format = "text";
  int threads = 0;
  InstructionSet isa;

  /// The first of the files to write that is no stream: finished parts are kept beside it. Empty if there is none.
  [[nodiscard]] std::string kept_beside() const;
  /// Throws InvalidArgument if two files to write are the same, or one is in `read`.
  void require_files(const std::vector<std::string>& read) const;
};

/// What a report says of the run.
struct FacetResult : FacetScene {
  std::uint32_t most_rays = 0;
  double seconds = 0;
  int threads = 0;  ///< of all ranks
  int ranks = 1;
  std::uint64_t memory = 0;  ///< the most bytes that the program had
  bool shows_objects = false;

  /// The last line of a report; `what` gets so many rays at most.
  [[nodiscard]] std::string spent(const char* what) const;
};

/// Writes the pictures that the options name, and prints the report.
void write_pictures(const FacetScene& scene, const FacetMap& map, const FacetOptions& options);
void print_report(const std::string& report, const FacetOptions& options);

}  // namespace shaftcull::cli
