// SPDX-License-Identifier: MIT
/// What `shaftcull cull` found, and its three formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh.hpp"
#include "report_format.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::cli {

/// What gets a bound of its own.
enum class Grain : std::uint8_t { object, part, triangle };

/// Stands for an object or a part where there is none.
inline constexpr std::uint32_t none = 0xffffffff;

/// The bound of an object, of a part of one, or of a triangle.
struct CullBound {
  Box box;
  std::uint32_t object;
  std::uint32_t part;      ///< position in MeshScene::parts, or none
  std::uint32_t triangle;  ///< position within the object, or none
};

/// A bound that a shaft keeps.
struct Candidate {
  std::size_t bound;  ///< position in CullReport::bounds
  bool inside;        ///< fully inside the shaft, else it overlaps it
  bool blocks;        ///< being solid it hides one end from the other; false unless that was asked
  float time = 0;     ///< when the moving box reaches the bound, if that was asked
};

/// One end of a shaft: an object, a part of one, or a box of the user's.
struct ShaftEnd {
  Box box;
  std::string label;
  std::uint32_t object = none;
  std::uint32_t part = none;  ///< position in MeshScene::parts

  /// Whether `bound` is the end itself or belongs to it.
  [[nodiscard]] bool holds(const CullBound& bound) const noexcept {
    return part != none ? bound.part == part : object != none && bound.object == object;
  }
};

/// The candidates of one shaft, by position.
struct PairResult {
  ShaftEnd from;  ///< not of a hull
  ShaftEnd to;    ///< not of a hull, nor of a body that is swept
  std::vector<Candidate> candidates;
};

/// Everything that a report tells.
struct CullReport {
  std::string path;
  Grain grain;
  std::string isa;
  MeshScene scene;
  std::vector<CullBound> bounds;  ///< by object, then by part or triangle
  std::vector<PairResult> pairs;
  bool solid;       ///< whether it was asked what blocks
  bool times;       ///< whether it was asked when bounds are reached
  bool first_only;  ///< whether it was asked which is reached first
  ShaftChoice choice;
  std::string triangles;  ///< how triangles are tested, vertices or exact; empty if boxes around them are
};

/// The whole report, ended by a newline. Text spells control characters of names out; JSON is one object; CSV is
/// RFC 4180 with a header line.
[[nodiscard]] std::string format_report(const CullReport& report, ReportFormat format);

}  // namespace shaftcull::cli
