// SPDX-License-Identifier: MIT
/// Which patches or groups lie behind all planes of a cone, as what a solid hides from one end does.
///
/// What is computed of a corner is off by the plane's error at most, so a lane is certain or left to the exact
/// predicate. No operation is fused: certain lanes are the same on all instruction sets, and groups need no exact step.
#pragma once

#include "kernels/shared/word.hpp"
#include "kernels/siblings/facing.hpp"
#include "kernels/siblings/siblings.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// normal·p − offset, of points in three streams from a lane on.
template <class L>
typename L::Vector height_above(const ConePlane& plane, const float* x, const float* y, const float* z,
                                unsigned lane) noexcept {
  auto sum = L::multiply(L::all(plane.normal[0]), L::load(x + lane));
  sum = L::add(sum, L::multiply(L::all(plane.normal[1]), L::load(y + lane)));
  sum = L::add(sum, L::multiply(L::all(plane.normal[2]), L::load(z + lane)));
  return L::subtract(sum, L::all(plane.offset));
}

/// The heights of corners above a plane, of each lane.
template <class L>
struct Heights {
  typename L::Vector highest;
  typename L::Vector lowest;
};

/// Lanes behind all planes; heights(plane, lane) are those of their corners.
template <class L, class HeightsOf>
BehindCone behind_all(const ConePlane* planes, std::size_t number, unsigned count, std::uint64_t asked,
                      const HeightsOf& heights) noexcept {
  BehindCone behind{asked & lanes_up_to<L>(count), 0};
  for (unsigned lane = 0; lane < count; lane += L::width) {
    const std::uint64_t here = behind.possible & lanes_of<L>(lane);
    std::uint64_t possible = here;
    std::uint64_t certain = here;
    for (std::size_t i = 0; i != number && possible != 0; ++i) {
      const Heights<L> of = heights(planes[i], lane);
      const ConePlane& plane = planes[i];
      const auto above = L::either(L::less(L::all(plane.possible.highest), of.highest),
                                   L::less(L::all(plane.possible.lowest), of.lowest));
      const auto behind_it = L::both(L::less_equal(of.highest, L::all(plane.certain.highest)),
                                     L::less_equal(of.lowest, L::all(plane.certain.lowest)));
      possible &= ~(L::bits(above) << lane);
      certain &= L::bits(behind_it) << lane;
    }
    behind.possible &= ~here | possible;
    behind.certain |= certain & possible;
  }
  return behind;
}

/// As SiblingKernels has it.
template <class L>
BehindCone corners_behind_cone(const ConePlane* planes, std::size_t number, const float* const* corner,
                               unsigned corners, unsigned count, std::uint64_t asked) noexcept {
  return behind_all<L>(planes, number, count, asked, [&](const ConePlane& plane, unsigned lane) {
    auto highest = height_above<L>(plane, corner[0], corner[1], corner[2], lane);
    auto lowest = highest;
    for (unsigned c = 1; c < corners; ++c) {
      const float* const* const at = corner + 3 * c;
      const auto height = height_above<L>(plane, at[0], at[1], at[2], lane);
      highest = L::maximum(highest, height);
      lowest = L::minimum(lowest, height);
    }
    return Heights<L>{highest, lowest};
  });
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t planes_behind_points(const float (&normal)[3][most_siblings], const float* limit, unsigned count,
                                   const Vec3* points, std::size_t size, std::uint64_t asked) noexcept {
  std::uint64_t behind = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    if ((asked & lanes_of<L>(lane)) == 0) continue;
    const auto most = L::load(limit + lane);
    for (std::size_t i = 0; i != size; ++i) {
      auto sum = L::multiply(L::all(points[i][0]), L::load(normal[0] + lane));
      sum = L::multiply_add(L::all(points[i][1]), L::load(normal[1] + lane), sum);
      sum = L::multiply_add(L::all(points[i][2]), L::load(normal[2] + lane), sum);
      behind |= L::bits(L::less(most, sum)) << lane;
    }
  }
  return behind & asked;
}

/// As SiblingKernels has it.
template <class L>
BehindCone boxes_behind_cone(const ConePlane* planes, std::size_t number, const float* const* boxes, unsigned count,
                             std::uint64_t asked) noexcept {
  return behind_all<L>(planes, number, count, asked, [&](const ConePlane& plane, unsigned lane) {
    const auto farthest = [&](unsigned k) { return plane.normal[k] > 0 ? boxes[k + 3] : boxes[k]; };
    const auto nearest = [&](unsigned k) { return plane.normal[k] > 0 ? boxes[k] : boxes[k + 3]; };
    return Heights<L>{height_above<L>(plane, farthest(0), farthest(1), farthest(2), lane),
                      height_above<L>(plane, nearest(0), nearest(1), nearest(2), lane)};
  });
}

}  // namespace shaftcull::kernel
