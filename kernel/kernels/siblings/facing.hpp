// SPDX-License-Identifier: MIT
/// Which boxes and corners lie on or behind planes of patches.
///
/// The corner of a box that is farthest in front of a plane decides: normal·corner − offset ≤ 0. The computed value is
/// off by at most `error`, within which the exact predicate decides. Where that is 0, as for planes across an axis, the
/// computed sign is right. A patch with corners may have several planes that nearly agree: `error` covers them all.
#pragma once

#include <cstring>

#include "kernels/shared/word.hpp"
#include "kernels/siblings/form.hpp"
#include "kernels/siblings/siblings.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// `of` as exact predicates take it.
template <class L>
struct ThreeFloats {
  float of[3];
};

/// All lanes of up to 64.
template <class L>
std::uint64_t lanes_up_to(unsigned count) noexcept {
  return count == word_bits ? ~std::uint64_t{0} : first_bits(count);
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t behind_plane(const PlaneRow& plane, const float* const* boxes, unsigned count) noexcept {
  const float* farthest[3];
  typename L::Vector normal[3];
  for (unsigned k = 0; k < 3; ++k) {
    farthest[k] = plane.least_normal[k] > 0 ? boxes[k + 3] : boxes[k];
    normal[k] = L::all(plane.least_normal[k]);
  }
  const auto offset = L::all(plane.least_offset);
  std::uint64_t behind = 0;
  std::uint64_t in_front = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    auto sum = L::multiply(normal[0], L::load(farthest[0] + lane));
    sum = L::multiply_add(normal[1], L::load(farthest[1] + lane), sum);
    sum = L::multiply_add(normal[2], L::load(farthest[2] + lane), sum);
    const auto value = L::subtract(sum, offset);
    behind |= L::bits(L::less_equal(value, L::all(-plane.error))) << lane;
    in_front |= L::bits(L::less(L::all(plane.error), value)) << lane;
  }
  const std::uint64_t lanes = lanes_up_to<L>(count);
  const std::uint64_t undecided = lanes & ~behind & ~in_front;
  behind &= lanes;
  if (undecided == 0) [[likely]]
    return behind;
  return behind | decide_lanes<L>(undecided, [&](unsigned lane) {
           const BoundAt<L, 6> box(boxes, lane);
           return plane.exact.is_box_behind(plane.lane, box.value);
         });
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t corners_behind_plane(const PlaneRow& plane, const float* const* corner, unsigned corners, unsigned count,
                                   std::uint64_t asked) noexcept {
  typename L::Vector normal[3];
  for (unsigned k = 0; k < 3; ++k) normal[k] = L::all(plane.least_normal[k]);
  const auto offset = L::all(plane.least_offset);
  const auto error = L::all(plane.error);
  const auto behind_from = L::all(-plane.error);
  std::uint64_t in_front = 0;
  std::uint64_t certain = ~std::uint64_t{0};
  asked &= lanes_up_to<L>(count);
  for (unsigned lane = 0; lane < count; lane += L::width) {
    std::uint64_t left = asked & lanes_of<L>(lane);
    for (unsigned c = 0; c < corners && left != 0; ++c) {
      auto sum = L::multiply(normal[0], L::load(corner[3 * c] + lane));
      sum = L::multiply_add(normal[1], L::load(corner[3 * c + 1] + lane), sum);
      sum = L::multiply_add(normal[2], L::load(corner[3 * c + 2] + lane), sum);
      const auto value = L::subtract(sum, offset);
      left &= ~(L::bits(L::less(error, value)) << lane);
      certain &= L::bits(L::less_equal(value, behind_from)) << lane | ~lanes_of<L>(lane);
    }
    in_front |= asked & lanes_of<L>(lane) & ~left;
  }
  asked &= ~in_front;
  const std::uint64_t undecided = asked & ~certain;
  if (undecided == 0) [[likely]]
    return asked;
  return (asked & certain) | decide_lanes<L>(undecided, [&](unsigned lane) {
           bool is_behind = true;
           for (unsigned c = 0; c < corners && is_behind; ++c) {
             const BoundAt<L, 3> point(corner + 3 * c, lane);
             is_behind = plane.exact.is_behind(plane.lane, point.value);
           }
           return is_behind;
         });
}

/// normal·corner for the corner of a box that is farthest in front, if it is certain for one of a group of planes.
template <class L, bool is_group>
typename L::Vector farthest_value(const PlaneStreams& planes, unsigned lane, const float* box) noexcept {
  typename L::Vector sum = L::all(0.0F);
  SHAFTCULL_UNROLL(3)
  for (unsigned k = 0; k < 3; ++k) {
    const auto lo = L::all(box[k]);
    const auto hi = L::all(box[k + 3]);
    const auto least = L::load(planes.least_normal[k] + lane);
    auto farthest = L::maximum(L::multiply(least, lo), L::multiply(least, hi));
    if constexpr (is_group) {
      const auto largest = L::load(planes.largest_normal[k] + lane);
      farthest = L::maximum(farthest, L::maximum(L::multiply(largest, lo), L::multiply(largest, hi)));
    }
    sum = L::add(sum, farthest);
  }
  return L::subtract(sum, L::load(planes.least_offset + lane));
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t behind_planes(const PlaneStreams& planes, unsigned count, const float* box,
                            std::uint64_t asked) noexcept {
  std::uint64_t behind = 0;
  std::uint64_t in_front = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    if ((asked & lanes_of<L>(lane)) == 0) continue;
    const auto value = farthest_value<L, false>(planes, lane, box);
    const auto error = L::load(planes.error + lane);
    behind |= L::bits(L::less_equal(value, L::subtract(L::all(0.0F), error))) << lane;
    in_front |= L::bits(L::less(error, value)) << lane;
  }
  const std::uint64_t lanes = lanes_up_to<L>(count) & asked;
  const std::uint64_t undecided = lanes & ~behind & ~in_front;
  behind &= lanes;
  if (undecided == 0) [[likely]]
    return behind;
  return behind | decide_lanes<L>(undecided, [&](unsigned lane) {
           const SixFaces<L> faces(box);
           return planes.exact.is_box_behind(lane, faces.face);
         });
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t points_behind_planes(const PlaneStreams& planes, unsigned count, const Vec3* points, std::size_t size,
                                   std::uint64_t asked) noexcept {
  for (std::size_t i = 0; i != size && asked != 0; ++i) {
    ThreeFloats<L> point;
    std::memcpy(point.of, &points[i], sizeof point.of);
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < count; lane += L::width) {
      if ((asked & lanes_of<L>(lane)) == 0) continue;
      auto sum = L::multiply(L::all(point.of[0]), L::load(planes.least_normal[0] + lane));
      sum = L::multiply_add(L::all(point.of[1]), L::load(planes.least_normal[1] + lane), sum);
      sum = L::multiply_add(L::all(point.of[2]), L::load(planes.least_normal[2] + lane), sum);
      const auto value = L::subtract(sum, L::load(planes.least_offset + lane));
      const auto error = L::load(planes.error + lane);
      const std::uint64_t behind = L::bits(L::less_equal(value, L::subtract(L::all(0.0F), error))) << lane;
      const std::uint64_t in_front = L::bits(L::less(error, value)) << lane;
      undecided |= ~behind & ~in_front & lanes_of<L>(lane);
      asked &= ~in_front;
    }
    undecided &= asked;
    if (undecided == 0) [[likely]]
      continue;
    asked &=
        ~undecided | decide_lanes<L>(undecided, [&](unsigned lane) { return planes.exact.is_behind(lane, point.of); });
  }
  return asked;
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t behind_groups(const PlaneStreams& groups, unsigned count, const float* box,
                            std::uint64_t asked) noexcept {
  std::uint64_t behind = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    if ((asked & lanes_of<L>(lane)) == 0) continue;
    const auto value = farthest_value<L, true>(groups, lane, box);
    behind |= L::bits(L::less_equal(value, L::subtract(L::all(0.0F), L::load(groups.error + lane)))) << lane;
  }
  return behind & lanes_up_to<L>(count) & asked;
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t behind_group(const PlaneRow& group, const float* const* boxes, unsigned count) noexcept {
  std::uint64_t behind = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    typename L::Vector sum = L::all(0.0F);
    SHAFTCULL_UNROLL(3)
    for (unsigned k = 0; k < 3; ++k) {
      const auto lo = L::load(boxes[k] + lane);
      const auto hi = L::load(boxes[k + 3] + lane);
      const auto least = L::all(group.least_normal[k]);
      const auto largest = L::all(group.largest_normal[k]);
      sum = L::add(sum, L::maximum(L::maximum(L::multiply(least, lo), L::multiply(least, hi)),
                                   L::maximum(L::multiply(largest, lo), L::multiply(largest, hi))));
    }
    const auto value = L::subtract(sum, L::all(group.least_offset));
    behind |= L::bits(L::less_equal(value, L::all(-group.error))) << lane;
  }
  return behind & lanes_up_to<L>(count);
}

}  // namespace shaftcull::kernel
