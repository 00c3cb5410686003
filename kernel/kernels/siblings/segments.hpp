// SPDX-License-Identifier: MIT
/// Which segments from one point to each of up to 64 others certainly pass through a triangle
/// (exact/deep_segments.hpp).
#pragma once

#include "kernels/shared/word.hpp"
#include "kernels/siblings/siblings.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// As SiblingKernels has it.
template <class L>
std::uint64_t segments_through(const SeenTriangle& triangle, const float* const* end, const float* least,
                               unsigned count, std::uint64_t asked) noexcept {
  std::uint64_t through = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    if ((asked & lanes_of<L>(lane)) == 0) continue;
    const auto x = L::load(end[0] + lane);
    const auto y = L::load(end[1] + lane);
    const auto z = L::load(end[2] + lane);
    const auto distance = L::load(least + lane);
    auto passes = L::less_equal(distance, L::all(triangle.distance));
    SHAFTCULL_UNROLL(4)
    for (unsigned i = 0; i < 4; ++i) {
      auto height = L::multiply(L::all(triangle.normal[i][0]), x);
      height = L::multiply_add(L::all(triangle.normal[i][1]), y, height);
      height = L::multiply_add(L::all(triangle.normal[i][2]), z, height);
      const auto offset = L::all(triangle.offset[i]);
      passes = L::both(passes, L::less_equal(i == 3 ? L::add(offset, distance) : offset, height));
    }
    through |= L::bits(passes) << lane;
  }
  return through & asked;
}

}  // namespace shaftcull::kernel
