// SPDX-License-Identifier: MIT
#include "peers/six_planes.hpp"

#include <algorithm>
#include <cmath>

namespace shaftcull::bench {

void cull_by_six_planes(const SixPlanes& planes, std::span<const CentreExtent> boxes, std::uint64_t* kept) noexcept {
  const auto is_kept = [&](const CentreExtent& box) {
    for (const Plane& plane : planes) {
      float distance = -plane.offset;
      float reach = 0;
      for (std::size_t k = 0; k != 3; ++k) {
        distance += plane.normal[k] * box.centre[k];
        reach += std::fabs(plane.normal[k]) * box.half_extent[k];
      }
      if (distance > reach) return false;
    }
    return true;
  };
  std::fill_n(kept, bit_words(boxes.size()), std::uint64_t{0});
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    kept[i / 64] |= static_cast<std::uint64_t>(is_kept(boxes[i])) << i % 64;
  }
}

}  // namespace shaftcull::bench
