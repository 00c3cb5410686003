/// What `shaftcull cull` found, and its three formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

/// A bound that may lie between the two ends of a shaft.
struct Candidate {
  std::size_t bound;  ///< position in MeshScene::bounds
  bool inside;        ///< fully inside the shaft, else it overlaps it
};

/// One end of a shaft: an object, or a box of the user's.
struct ShaftEnd {
  static constexpr std::uint32_t no_object = 0xffffffff;
  Box box;
  std::string label;
  std::uint32_t object = no_object;
};

/// The candidates between two ends, by position.
struct PairResult {
  ShaftEnd from;
  ShaftEnd to;
  std::vector<Candidate> candidates;
};

/// Everything that a report tells.
struct CullReport {
  std::string path;
  Grain grain;
  std::string isa;
  MeshScene scene;
  std::vector<PairResult> pairs;
};

enum class ReportFormat : std::uint8_t { text, json, csv };

/// The whole report, ended by a newline. JSON is one object; CSV is RFC 4180 with a header line.
[[nodiscard]] std::string format_report(const CullReport& report, ReportFormat format);

}  // namespace shaftcull::cli
