// SPDX-License-Identifier: MIT
/// The tests of a single bound, as Kernels has them.
#pragma once

#include <cstdint>

#include "compiled/with_planes.hpp"
#include "kernels/boxes/box_stages.hpp"
#include "kernels/hulls/hull_one_by_one.hpp"
#include "kernels/spheres/sphere_stages.hpp"
#include "shaftcull/cull.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// The streams of one bound.
template <class L, unsigned streams>
struct StreamsOfOne {
  const float* of[streams];

  explicit StreamsOfOne(const float* bound) noexcept {
    for (unsigned s = 0; s < streams; ++s) of[s] = bound + s;
  }
};

/// The answers of shafts that are no hulls. Not inlined, so that a box which lanes decide does not wait for their
/// stack.
template <class L, class Stages>
SHAFTCULL_NOINLINE bool keeps_single(const ShaftData& shaft, const float* bound) noexcept {
  const WithPlanes completed(shaft, Stages::needs_planes(shaft));
  std::uint64_t kept = 0;
  Stages::cull(completed.shaft(), StreamsOfOne<L, Stages::streams>(bound).of, 1, &kept);
  return kept != 0;
}

/// Whether a box, or the centre of a sphere, is not within the box around a shaft between two boxes. Then the bound is
/// not inside, whatever the joining planes are.
template <class Stages>
bool reaches_out(const ShaftData& shaft, const float* const* stream) noexcept {
  if (shaft.kind != ShaftData::Kind::between) return false;
  constexpr unsigned hi = Stages::streams == 6 ? 3 : 0;
  for (unsigned k = 0; k != 3; ++k) {
    const float below = *stream[k];
    const float above = *stream[k + hi];
    if ((below < shaft.a[k] && below < shaft.b[k]) || (above > shaft.a[k + 3] && above > shaft.b[k + 3])) return true;
  }
  return false;
}

/// Whether all corners of a box that the shaft keeps are in the shaft or touch it. Then the box is inside, since a
/// shaft is convex. One test of eight points costs less than the joining planes of the shaft.
template <class L, class Stages>
bool keeps_corners(const ShaftData& shaft, const float* const* stream) noexcept {
  float coordinate[3][8];
  for (unsigned k = 0; k != 3; ++k) {
    const float lo = *stream[k];
    const float hi = *stream[k + 3];
    if (!(lo <= hi)) return false;  // NaN: not inside
    for (unsigned corner = 0; corner != 8; ++corner) coordinate[k][corner] = (corner >> k & 1U) != 0 ? hi : lo;
  }
  const float* const corners[6] = {coordinate[0], coordinate[1], coordinate[2],
                                   coordinate[0], coordinate[1], coordinate[2]};
  ShaftData closed;  // written only if the shaft has open contact
  const bool is_open = shaft.contact != Contact::closed;
  if (is_open) {
    closed = shaft;
    closed.contact = Contact::closed;
    closed.still_faces = 0;
  }
  std::uint64_t kept = 0;
  Stages::cull(is_open ? closed : shaft, corners, 8, &kept);
  return kept == 0xff;
}

/// What the shaft says of a bound that it keeps.
template <class L, class Stages>
SHAFTCULL_NOINLINE Answer classify_kept(const ShaftData& shaft, const float* bound) noexcept {
  const StreamsOfOne<L, Stages::streams> streams(bound);
  if (!shaft.has_planes()) {
    if (reaches_out<Stages>(shaft, streams.of)) return Answer::overlap;
    if constexpr (Stages::streams == 6)
      return keeps_corners<L, Stages>(shaft, streams.of) ? Answer::inside : Answer::overlap;
  }
  const WithPlanes completed(shaft, true);
  const std::uint64_t kept = 1;
  std::uint64_t inside = 0;
  Stages::find_inside(completed.shaft(), streams.of, 1, &kept, &inside);
  return inside == 0 ? Answer::overlap : Answer::inside;
}

/// Whether a box is kept, by a shaft's constraints in the lanes of one vector: 1 or 0, or −1 where these do not decide.
template <class L, class Slab>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline int keeps_by_slab(const ShaftData& shaft, const float* box) noexcept {
  const Slab slab(shaft);
  const float length = slab.interval_length(L::EightFloats::load_faces(box));
  return length < 0 ? 0 : length > slab.two_margins() ? 1 : -1;
}

/// Likewise, for shafts whose constraints are all that there is. −1 for others.
template <class L>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline int keeps_by_lanes(const ShaftData& shaft, const float* box) noexcept {
  if constexpr (L::EightFloats::in_one_register) {
    if (shaft.form == Form::planes || !BoxStages<L>::is_finished(shaft)) return -1;
    if (SlabInLanes<L>::suits(shaft)) return keeps_by_slab<L, SlabInLanes<L>>(shaft, box);
    if (EndlessSlabInLanes<L>::suits(shaft)) return keeps_by_slab<L, EndlessSlabInLanes<L>>(shaft, box);
  }
  return -1;
}

template <class L>
bool keeps_box(const ShaftData& shaft, const float* box) noexcept {
  if (const int keeps = keeps_by_lanes<L>(shaft, box); keeps >= 0) [[likely]]
    return keeps != 0;
  if (shaft.is_hull()) [[unlikely]]
    return keeps_box_by_hull<L>(shaft, box);
  return keeps_single<L, BoxStages<L>>(shaft, box);
}

template <class L>
bool keeps_sphere(const ShaftData& shaft, const float* sphere) noexcept {
  if (shaft.is_hull()) [[unlikely]]
    return keeps_sphere_by_hull<L>(shaft, sphere);
  return keeps_single<L, UnboxedSphereStages<L>>(shaft, sphere);
}

template <class L>
Answer classify_box(const ShaftData& shaft, const float* box) noexcept {
  if (shaft.is_hull()) [[unlikely]]
    return classify_box_by_hull<L>(shaft, box);
  return keeps_box<L>(shaft, box) ? classify_kept<L, BoxStages<L>>(shaft, box) : Answer::outside;
}

template <class L>
Answer classify_sphere(const ShaftData& shaft, const float* sphere) noexcept {
  if (shaft.is_hull()) [[unlikely]]
    return classify_sphere_by_hull<L>(shaft, sphere);
  return keeps_sphere<L>(shaft, sphere) ? classify_kept<L, UnboxedSphereStages<L>>(shaft, sphere) : Answer::outside;
}

}  // namespace shaftcull::kernel
