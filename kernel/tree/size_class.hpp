// SPDX-License-Identifier: MIT
/// Size classes: bounds much larger than a node of small ones get nodes of their own, and so do empty ones.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "streams/strided_reader.hpp"
#include "tree/entries.hpp"

namespace shaftcull::kernel {

/// Centre and largest extent of a bound; the centre is finite even if the bound is not.
struct Placement {
  Vec3 centre;
  float extent;  ///< that of the nearest finite bound; negative for the empty box
};

/// Of a box as in a BoxView.
inline Placement placement(const float (&box)[6]) noexcept {
  constexpr float most = std::numeric_limits<float>::max();
  Placement place{};
  for (std::size_t k = 0; k != 3; ++k) {
    const float lo = std::clamp(box[k], -most, most);
    const float hi = std::clamp(box[k + 3], -most, most);
    place.centre[k] = 0.5F * lo + 0.5F * hi;
    place.extent = k == 0 ? hi - lo : std::max(place.extent, hi - lo);
  }
  return place;
}

/// Of a sphere as in a SphereView.
inline Placement placement(const float (&sphere)[4]) noexcept {
  return {{sphere[0], sphere[1], sphere[2]}, 2 * sphere[3]};
}

/// Whether a bound is legal, finite, and not the empty box.
inline bool is_plain(const float (&box)[6]) noexcept {
  constexpr float most = std::numeric_limits<float>::max();
  return (box[0] <= box[3]) & (box[1] <= box[4]) & (box[2] <= box[5]) &  //
         (box[3] - box[0] <= most) & (box[4] - box[1] <= most) & (box[5] - box[2] <= most);
}
inline bool is_plain(const float (&sphere)[4]) noexcept { return SphereReader::is_legal(sphere); }

/// placement() of a plain bound: nothing in it is a branch, so that loops become vectors.
inline Placement plain_placement(const float (&box)[6]) noexcept {
  const float width[3] = {box[3] - box[0], box[4] - box[1], box[5] - box[2]};
  const float two = width[0] < width[1] ? width[1] : width[0];
  return {{0.5F * box[0] + 0.5F * box[3], 0.5F * box[1] + 0.5F * box[4], 0.5F * box[2] + 0.5F * box[5]},
          two < width[2] ? width[2] : two};
}
inline Placement plain_placement(const float (&sphere)[4]) noexcept { return placement(sphere); }

/// The size that a node of 64 small bounds has: that of its share of the space (or plane, or line) that all but a few
/// centres are in. `sample` holds some of the centres.
inline float usual_node_size(std::vector<Vec3> sample, std::size_t count) {
  if (sample.empty()) return 0;
  std::array<double, 3> width{};
  for (std::size_t k = 0; k != 3; ++k) {
    std::sort(sample.begin(), sample.end(), [k](const Vec3& a, const Vec3& b) { return a[k] < b[k]; });
    const std::size_t few = sample.size() / 50;
    width[k] = static_cast<double>(sample[sample.size() - 1 - few][k]) - static_cast<double>(sample[few][k]);
  }
  std::sort(width.begin(), width.end(), std::greater<>());
  const double share = std::min(1.0, 64.0 / static_cast<double>(count));
  const double size = std::max({width[0] * share, std::sqrt(width[0]) * std::sqrt(width[1] * share),
                                std::cbrt(width[0]) * std::cbrt(width[1]) * std::cbrt(width[2] * share)});
  return static_cast<float>(std::min(size, 3e38));
}

/// Whether a bound is of class 0: one of at most twice the usual node.
inline bool is_small(float extent, float node_size) noexcept { return (extent >= 0) & (0.5F * extent <= node_size); }

/// 0 for small bounds, one more for every further factor of 8; the last class is of empty boxes.
inline unsigned size_class(float extent, float node_size) noexcept {
  if (extent < 0) return size_classes - 1;
  if (is_small(extent, node_size)) return 0;
  unsigned c = 1;
  for (double limit = 16.0 * static_cast<double>(node_size);
       c != size_classes - 2 && static_cast<double>(extent) > limit; limit *= 8)
    ++c;
  return c;
}

}  // namespace shaftcull::kernel
