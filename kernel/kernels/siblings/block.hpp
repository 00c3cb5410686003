// SPDX-License-Identifier: MIT
/// Which of sibling shafts a solid box blocks.
///
/// As kernels/blocking/blocking_boxes.hpp tests many boxes with one shaft: lo(t) > box.lo and hi(t) < box.hi, where
/// lo(t) > x bounds t from below if lo grows.
#pragma once

#include "exact/blocking.hpp"
#include "kernels/shared/two_axes.hpp"
#include "kernels/siblings/form.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// A solid in all lanes.
template <class L>
class SolidInLanes {
  using Vector = typename L::Vector;
  using Mask = typename L::Mask;

 public:
  explicit SolidInLanes(const BoxRow& solid) noexcept : solid_(solid) {
    for (unsigned f = 0; f < 6; ++f) face_[f] = L::all(solid.face[f]);
    for (unsigned k = 0; k < 3; ++k) is_flat_ |= solid.face[k] == solid.face[k + 3];
  }

  /// Siblings of `asked` that it blocks.
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] std::uint64_t occluded(const Siblings& siblings,
                                                               std::uint64_t asked) const noexcept {
    if (!siblings.solids_around_ends) [[unlikely]]
      asked &= ~reaching_ends(siblings, asked);
    std::uint64_t occluded = 0;
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < siblings.count; lane += L::width) {
      if ((asked & lanes_of<L>(lane)) == 0) continue;
      const std::uint64_t touching = L::bits(may_reach_across(siblings, lane)) << lane;
      if ((asked & touching) == 0) continue;
      const std::uint64_t across = touching & L::bits(reaches_across(siblings, lane)) << lane;
      const Vector sum = largest_sum(siblings, lane);
      const std::uint64_t possible = L::bits(L::less_equal(sum, L::all(1 + margin()))) << lane;
      const std::uint64_t certain = across & L::bits(L::less(sum, L::all(1 - margin()))) << lane;
      occluded |= certain;
      // A flat solid may be in the plane of both ends.
      undecided |= (is_flat_ ? touching : across) & possible & ~certain;
    }
    occluded &= asked;
    undecided = (undecided | siblings.inexact) & asked;
    if (undecided == 0) [[likely]]
      return occluded;
    const SixFaces<L> solid(solid_.face);
    return (occluded & ~undecided) | decide_lanes<L>(undecided, [&](unsigned lane) {
             const OpenEnds<L> ends(siblings, lane);
             return box_blocks(ends.fixed, ends.other, solid.face);
           });
  }

  /// Siblings of `asked` that it may block.
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] std::uint64_t may_block(const Siblings& siblings,
                                                                std::uint64_t asked) const noexcept {
    std::uint64_t possible = siblings.inexact;
    for (unsigned lane = 0; lane < siblings.count; lane += L::width) {
      if ((asked & lanes_of<L>(lane)) == 0) continue;
      const std::uint64_t touching = L::bits(may_reach_across(siblings, lane)) << lane;
      if ((asked & touching) == 0) continue;
      possible |= touching & L::bits(L::less_equal(largest_sum(siblings, lane), L::all(1 + margin()))) << lane;
    }
    return possible & asked;
  }

 private:
  static float margin() noexcept { return blocking_margin; }

  /// Whether it reaches across a shaft on all axes, or touches it.
  [[nodiscard]] Mask may_reach_across(const Siblings& siblings, unsigned lane) const noexcept {
    Mask may = may_reach_across(siblings, lane, 0);
    SHAFTCULL_UNROLL(2)
    for (unsigned k = 1; k < 3; ++k) may = L::both(may, may_reach_across(siblings, lane, k));
    return may;
  }
  [[nodiscard]] Mask may_reach_across(const Siblings& siblings, unsigned lane, unsigned k) const noexcept {
    return L::both(L::less_equal(face_[k], L::load(&siblings.inner[k][lane])),
                   L::less_equal(L::load(&siblings.inner[k + 3][lane]), face_[k + 3]));
  }

  /// Whether it reaches across: of each of its faces, one of the two ends is on the inner side.
  [[nodiscard]] Mask reaches_across(const Siblings& siblings, unsigned lane) const noexcept {
    Mask across = has_end_within(siblings, lane, 0);
    SHAFTCULL_UNROLL(5)
    for (unsigned f = 1; f < 6; ++f) across = L::both(across, has_end_within(siblings, lane, f));
    return across;
  }
  [[nodiscard]] Mask has_end_within(const Siblings& siblings, unsigned lane, unsigned f) const noexcept {
    const auto precedes = [&](Vector face, Vector inward) {
      return f < 3 ? L::both(L::less_equal(face_[f], face), L::less(face_[f], inward))
                   : L::both(L::less_equal(face, face_[f]), L::less(inward, face_[f]));
    };
    return L::either(precedes(L::all(siblings.fixed[f]), L::all(siblings.fixed_inward[f])),
                     precedes(L::load(siblings.other[f] + lane), L::load(siblings.other_inward[f] + lane)));
  }

  /// Siblings into one of whose ends it reaches: its inside, or if it is flat, itself.
  [[nodiscard]] std::uint64_t reaching_ends(const Siblings& siblings, std::uint64_t asked) const noexcept {
    bool reaches_fixed = true;
    for (unsigned k = 0; k < 3; ++k) {
      reaches_fixed &= is_flat_ ? solid_.face[k] <= siblings.fixed[k + 3] && siblings.fixed[k] <= solid_.face[k + 3]
                                : solid_.face[k] < siblings.fixed[k + 3] && siblings.fixed[k] < solid_.face[k + 3];
    }
    if (reaches_fixed) return asked;
    std::uint64_t reached = 0;
    for (unsigned lane = 0; lane < siblings.count; lane += L::width) {
      Mask reaches = L::less_equal(L::all(0.0F), L::all(0.0F));
      SHAFTCULL_UNROLL(3)
      for (unsigned k = 0; k < 3; ++k) {
        const Vector lo = L::load(siblings.other[k] + lane);
        const Vector hi = L::load(siblings.other[k + 3] + lane);
        reaches = L::both(reaches, is_flat_ ? L::both(L::less_equal(face_[k], hi), L::less_equal(lo, face_[k + 3]))
                                            : L::both(L::less(face_[k], hi), L::less(lo, face_[k + 3])));
      }
      reached |= L::bits(reaches) << lane;
    }
    return reached;
  }

  /// As BoundInLanes has it.
  SHAFTCULL_ALWAYS_INLINE [[nodiscard]] Vector largest_sum(const Siblings& siblings, unsigned lane) const noexcept {
    Vector since[3];
    Vector until[3];
    const Vector none = L::all(0.0F);
    SHAFTCULL_UNROLL(3)
    for (unsigned k = 0; k < 3; ++k) {
      const Vector lo = L::subtract(face_[k], L::load(&siblings.outer[k][lane]));
      const Vector hi = L::subtract(L::load(&siblings.outer[k + 3][lane]), face_[k + 3]);
      since[k] = L::maximum(L::multiply(lo, L::load(&siblings.forward[k][lane])),
                            L::maximum(L::multiply(hi, L::load(&siblings.backward[k + 3][lane])), none));
      until[k] = L::maximum(L::multiply(lo, L::load(&siblings.backward[k][lane])),
                            L::maximum(L::multiply(hi, L::load(&siblings.forward[k + 3][lane])), none));
    }
    return largest_sum_of_two_axes<L>(since, until);
  }

  const BoxRow& solid_;
  Vector face_[6];
  bool is_flat_ = false;
};

/// As SiblingKernels has it.
template <class L>
std::uint64_t block_siblings(const Siblings& siblings, const BoxRow* solids, const std::uint32_t* list,
                             std::size_t count, const std::uint64_t* may_block, std::uint64_t asked) noexcept {
  const std::uint64_t all = asked;
  for (std::size_t i = 0; i != count && asked != 0; ++i) {
    const std::uint64_t lanes = may_block == nullptr ? asked : asked & may_block[i];
    if (lanes == 0) continue;
    asked &= ~SolidInLanes<L>(solids[list[i]]).occluded(siblings, lanes);
  }
  return all & ~asked;
}

/// As SiblingKernels has it.
template <class L>
void may_block_siblings(const Siblings& siblings, const BoxRow* solids, const std::uint32_t* list, std::size_t count,
                        const std::uint64_t* may_block, std::uint64_t asked, std::uint64_t* kept) noexcept {
  for (std::size_t i = 0; i != count; ++i) {
    const std::uint64_t lanes = may_block == nullptr ? asked : asked & may_block[i];
    kept[i] = lanes == 0 ? 0 : SolidInLanes<L>(solids[list[i]]).may_block(siblings, lanes);
  }
}

}  // namespace shaftcull::kernel
