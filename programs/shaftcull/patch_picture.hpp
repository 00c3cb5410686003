// SPDX-License-Identifier: MIT
/// Pictures of patches from above, in the colours of shares.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "region.hpp"
#include "shaftcull/bounds.hpp"
#include "share_colours.hpp"

namespace shaftcull::cli {

/// Polygons, by their corners.
struct PictureFaces {
  std::vector<Point3> corners;
  std::vector<std::size_t> first{0};  ///< where those of each begin; then the last end
  bool both_sides = false;            ///< whether they are seen from both sides
  std::vector<Box> objects;           ///< what the picture is wide enough for

  [[nodiscard]] std::size_t size() const noexcept { return first.size() - 1; }
  [[nodiscard]] std::span<const Point3> of(std::size_t i) const {
    return std::span(corners).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// Shares of patches, in colours.
struct ShareMap {
  std::span<const double> shares;
  const ColourRamp& ramp;
  const char* name;   ///< of its colours, within the picture
  const char* words;  ///< what they are shares of
};

/// An SVG picture of the faces as seen along axis `up`, from where it points: those that face there. The maps lie
/// beside each other.
[[nodiscard]] std::string picture_of(const PictureFaces& faces, std::span<const ShareMap> maps, std::size_t up,
                                     const std::string& title);

}  // namespace shaftcull::cli
