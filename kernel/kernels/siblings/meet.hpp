// SPDX-License-Identifier: MIT
/// Which segments between corners of a patch and of up to 64 others certainly miss a solid: then it does not hide the
/// pair. Most solids that stand about between two patches are told so by one segment.
#pragma once

#include <cmath>

#include "kernels/shared/word.hpp"
#include "kernels/siblings/siblings.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// A solid as seen from a point: what a segment that begins there must not exceed to meet it. Room for rounding is in
/// all numbers (docs/exactness.md, "Segments past a solid").
template <class L>
struct SeenSolid {
  Vec3 from;
  float way[3];   ///< from the middle of the box around the solid to the point
  float half[3];  ///< of the box
  float lo[3];    ///< a segment ends here or farther up; −∞ if it begins there
  float hi[3];    ///< likewise
  float square;   ///< of the radius of a ball around the solid

  SeenSolid(const SolidBounds& solid, const Vec3& point) noexcept : from(point) {
    const auto magnitude = [](float x) { return x < 0 ? -x : x; };
    float reach = solid.radius;
    for (unsigned k = 0; k < 3; ++k) {
      way[k] = point[k] - solid.middle[k];
      half[k] = solid.half[k] + 0x1p-18F * magnitude(way[k]);
      lo[k] = point[k] < solid.lo[k] ? solid.lo[k] : -INFINITY;
      hi[k] = point[k] > solid.hi[k] ? solid.hi[k] : INFINITY;
      reach += 0x1p-18F * magnitude(way[k]);
    }
    square = reach * reach;
  }

  /// Lanes of the ends of segments that may meet the solid.
  [[nodiscard]] std::uint64_t meeting(const float* const* end, unsigned lane) const noexcept {
    using Vector = typename L::Vector;
    Vector way_to[3];
    Vector length[3];
    const Vector at[3] = {L::load(end[0] + lane), L::load(end[1] + lane), L::load(end[2] + lane)};
    auto meets = L::both(L::less_equal(L::all(lo[0]), at[0]), L::less_equal(at[0], L::all(hi[0])));
    for (unsigned k = 0; k < 3; ++k) {
      way_to[k] = L::subtract(at[k], L::all(from[k]));
      length[k] = L::magnitude(way_to[k]);
      if (k != 0)
        meets = L::both(meets, L::both(L::less_equal(L::all(lo[k]), at[k]), L::less_equal(at[k], L::all(hi[k]))));
    }
    const Vector least = L::all(0x1p-100F);
    Vector across = L::all(0.0F);
    Vector square_of_length = across;
    SHAFTCULL_UNROLL(3)
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned i = (k + 1) % 3;
      const unsigned j = (k + 2) % 3;
      const Vector moment = L::subtract(L::multiply(L::all(way[i]), way_to[j]), L::multiply(L::all(way[j]), way_to[i]));
      Vector most = L::multiply_add(L::all(half[i]), length[j], least);
      most = L::multiply_add(L::all(half[j]), length[i], most);
      meets = L::both(meets, L::less_equal(L::magnitude(moment), most));
      across = L::multiply_add(moment, moment, across);
      square_of_length = L::multiply_add(way_to[k], way_to[k], square_of_length);
    }
    const Vector most = L::multiply_add(L::all(square), square_of_length, least);
    return L::bits(L::both(meets, L::less_equal(across, most)));
  }
};

/// Lanes of `asked` that have a corner farther up an axis than a limit; downwards, if `sign` is −1.
template <class L>
std::uint64_t lanes_beyond(float sign, float limit, const float* const* corner, unsigned corners, unsigned count,
                           std::uint64_t asked) noexcept {
  std::uint64_t beyond = 0;
  const auto direction = L::all(sign);
  const auto least = L::all(sign * limit);
  for (unsigned lane = 0; lane < count; lane += L::width) {
    if ((asked & lanes_of<L>(lane)) == 0) continue;
    auto farthest = L::multiply(direction, L::load(corner[0] + lane));
    for (unsigned c = 1; c < corners; ++c) {
      farthest = L::maximum(farthest, L::multiply(direction, L::load(corner[3 * c] + lane)));
    }
    beyond |= L::bits(L::less(least, farthest)) << lane;
  }
  return beyond & asked;
}

/// Lanes of `asked` that are not, with the fixed patch, on the outer side of a face of the box around a solid, or in
/// its plane. No segment between the others passes through the interior of the solid.
template <class L>
std::uint64_t lanes_around_faces(const SolidBounds& solid, const Vec3* fixed, unsigned fixed_corners,
                                 const float* const* corner, unsigned corners, unsigned count,
                                 std::uint64_t asked) noexcept {
  for (unsigned k = 0; k < 3 && asked != 0; ++k) {
    float least = fixed[0][k];
    float most = least;
    for (unsigned i = 1; i < fixed_corners; ++i) {
      least = fixed[i][k] < least ? fixed[i][k] : least;
      most = fixed[i][k] > most ? fixed[i][k] : most;
    }
    if (most <= solid.lo[k]) asked = lanes_beyond<L>(1, solid.lo[k], corner + k, corners, count, asked);
    if (least >= solid.hi[k]) asked = lanes_beyond<L>(-1, solid.hi[k], corner + k, corners, count, asked);
  }
  return asked;
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t may_meet_solid(const SolidBounds& solid, const Vec3* fixed, unsigned fixed_corners,
                             const float* const* corner, unsigned corners, unsigned count,
                             std::uint64_t asked) noexcept {
  if (solid.has_interior) {
    asked = lanes_around_faces<L>(solid, fixed, fixed_corners, corner, corners, count, asked);
  }
  if (!solid.is_bounded) return asked;
  for (unsigned i = 0; i < fixed_corners && asked != 0; ++i) {
    const SeenSolid<L> seen(solid, fixed[i]);
    for (unsigned lane = 0; lane < count; lane += L::width) {
      std::uint64_t here = asked >> lane & lanes_of<L>(0);
      const std::uint64_t before = here;
      for (unsigned c = 0; c < corners && here != 0; ++c) {
        here &= seen.meeting(corner + 3 * ((i + c) % corners), lane);
      }
      asked &= ~((before & ~here) << lane);
    }
  }
  return asked;
}

}  // namespace shaftcull::kernel
