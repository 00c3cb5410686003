// SPDX-License-Identifier: MIT
/// Corners of patches in streams, as kernels read them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "exact/patch_plane.hpp"
#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull {

/// Padded, as streams of patches are.
class CornersInLanes {
 public:
  CornersInLanes(const std::vector<std::vector<Vec3>>& patches, unsigned corners) {
    for (std::size_t c = 0; c != corners; ++c) {
      for (std::size_t k = 0; k != 3; ++k) {
        for (std::size_t i = 0; i != patches.size(); ++i) of_[3 * c + k][i] = patches[i][c][k];
        stream_[3 * c + k] = of_[3 * c + k].data();
      }
    }
  }
  CornersInLanes(const CornersInLanes&) = delete;
  CornersInLanes& operator=(const CornersInLanes&) = delete;

  [[nodiscard]] const float* const* stream() const noexcept { return stream_.data(); }

 private:
  static constexpr std::size_t streams = std::size_t{3} * kernel::most_patch_corners;

  std::array<std::array<float, std::size_t{2} * kernel::most_siblings>, streams> of_{};
  std::array<const float*, streams> stream_{};
};

/// All eight, bit k of whose numbers says on which side of axis k they are.
inline std::vector<Vec3> corners_of_box_between(const Vec3& p, const Vec3& q) {
  std::vector<Vec3> corners(8);
  for (unsigned c = 0; c != 8; ++c) {
    for (unsigned k = 0; k != 3; ++k) corners[c][k] = (c >> k & 1U) != 0 ? std::max(p[k], q[k]) : std::min(p[k], q[k]);
  }
  return corners;
}

/// Without those that are there already.
inline std::vector<Vec3> distinct(const std::vector<Vec3>& corners) {
  std::vector<Vec3> some;
  for (const Vec3& corner : corners) {
    if (std::find(some.begin(), some.end(), corner) == some.end()) some.push_back(corner);
  }
  return some;
}

}  // namespace shaftcull
