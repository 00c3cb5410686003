// SPDX-License-Identifier: MIT
/// Forming sibling shafts.
#pragma once

#include "exact/blocking.hpp"
#include "kernels/blocking/blocking_boxes.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/siblings/siblings.hpp"

namespace shaftcull::kernel {

/// As SiblingKernels has it.
template <class L>
void form_siblings(const float* fixed, const float* const* other, unsigned count, std::uint64_t lanes,
                   Siblings& siblings) noexcept {
  siblings.count = count;
  siblings.fixed = fixed;
  siblings.other = other;
  const auto none = L::all(0.0F);
  const auto one = L::all(1.0F);
  const auto shortest = L::all(0x1p-126F);  // shorter or longer ones have no reciprocal with all its bits
  const auto longest = L::all(0x1p126F);
  std::uint64_t inexact = 0;
  for (unsigned lane = 0; lane < count; lane += L::width) {
    if ((lanes & lanes_of<L>(lane)) == 0) continue;
    for (unsigned f = 0; f < 6; ++f) {
      const auto from = L::all(fixed[f]);
      const auto to = L::load(other[f] + lane);
      const auto travel = L::subtract(to, from);
      const auto length = L::magnitude(travel);
      const auto reciprocal = L::divide(one, length);
      const auto forward = L::choose(L::less(none, travel), reciprocal, none);
      const auto backward = L::choose(L::less(travel, none), reciprocal, none);
      const auto usable = L::both(L::less_equal(shortest, length), L::less_equal(length, longest));
      const auto still = L::less_equal(length, none);
      inexact |= (lanes_of<L>(0) & ~L::bits(L::either(usable, still))) << lane;
      const auto smaller = L::minimum(to, from);
      const auto larger = L::maximum(to, from);
      L::store(&siblings.outer[f][lane], f < 3 ? smaller : larger);
      L::store(&siblings.inner[f][lane], f < 3 ? larger : smaller);
      L::store(&siblings.forward[f][lane], forward);
      L::store(&siblings.backward[f][lane], backward);
    }
  }
  siblings.inexact = inexact & lanes;
}

/// The other box of a sibling, as exact predicates take it.
template <class L>
struct OtherBox {
  float face[6];

  OtherBox(const Siblings& siblings, unsigned lane) noexcept {
    for (unsigned f = 0; f < 6; ++f) face[f] = siblings.other[f][lane];
  }
};

/// The two ends of a sibling without the faces that are left out.
template <class L>
struct OpenEnds {
  OpenBox fixed;
  OpenBox other;

  OpenEnds(const Siblings& siblings, unsigned lane) noexcept {
    for (unsigned f = 0; f < 6; ++f) {
      fixed.face[f] = siblings.fixed[f];
      fixed.inward[f] = siblings.fixed_inward[f];
      other.face[f] = siblings.other[f][lane];
      other.inward[f] = siblings.other_inward[f][lane];
    }
  }
};

/// The fixed box, or any row of six, likewise.
template <class L>
struct SixFaces {
  float face[6];

  explicit SixFaces(const float* from) noexcept {
    for (unsigned f = 0; f < 6; ++f) face[f] = from[f];
  }
};

}  // namespace shaftcull::kernel
