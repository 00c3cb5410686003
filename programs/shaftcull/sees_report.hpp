// SPDX-License-Identifier: MIT
/// What `shaftcull sees` found, in numbers.
#pragma once

#include <string>
#include <vector>

#include "report_format.hpp"
#include "sees_objects.hpp"

namespace shaftcull::cli {

struct SeesReport {
  std::string source;  ///< the file, or which rooms
  std::string isa;
  std::size_t objects;
  std::size_t triangles;
  std::size_t patches;
  double patch_size;
  float tolerance;  ///< 0 if patches are boxes
  std::size_t occluders;
  SeesSolids solids;
  std::uint32_t rays;
  SeesCounts counts;
  double seconds;
  int threads;  ///< of all ranks
  int ranks;
  std::uint64_t memory;                       ///< the most bytes that the program had, all in all
  std::vector<ObjectPair> object_pairs = {};  ///< empty if they are not asked for
};

/// The whole report, ended by a newline.
[[nodiscard]] std::string format_report(const SeesReport& report, ReportFormat format);

}  // namespace shaftcull::cli
