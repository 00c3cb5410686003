// SPDX-License-Identifier: MIT
/// Which of sibling shafts keep a box.
///
/// Outside of the shaft's box is decided by comparisons, exactly. Within it, constraints on t from a lo face are those
/// of the box's hi, and the other way round: the box's hi x is x, and lo(t) ≤ x bounds t from above where lo grows. It
/// is outside iff some s + u on different axes is more than 1; with open contact, 1 or more.
#pragma once

#include "exact/predicates.hpp"
#include "kernels/shared/two_axes.hpp"
#include "kernels/siblings/form.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// A bound in all lanes.
template <class L, Contact contact>
class BoundInLanes {
  using Vector = typename L::Vector;
  using Mask = typename L::Mask;

 public:
  explicit BoundInLanes(const BoxRow& bound) noexcept : bound_(bound) {
    for (unsigned f = 0; f < 6; ++f) face_[f] = L::all(bound.face[f]);
  }

  /// Siblings of `asked` that keep it.
  [[nodiscard]] std::uint64_t kept(const Siblings& siblings, std::uint64_t asked) const noexcept {
    std::uint64_t kept = 0;
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < siblings.count; lane += L::width) {
      if ((asked & lanes_of<L>(lane)) == 0) continue;
      const std::uint64_t reached = L::bits(reaches_box(siblings, lane)) << lane;
      if ((asked & reached) == 0) continue;
      const Vector sum = largest_sum(siblings, lane);
      const std::uint64_t certain = L::bits(L::less(sum, L::all(1 - margin()))) << lane;
      const std::uint64_t possible = L::bits(L::less_equal(sum, L::all(1 + margin()))) << lane;
      kept |= reached & certain;
      undecided |= reached & possible & ~certain;
    }
    kept &= asked;
    undecided = (undecided | siblings.inexact) & asked;
    if (undecided == 0) [[likely]]
      return kept;
    const SixFaces<L> fixed(siblings.fixed);
    const SixFaces<L> bound(bound_.face);
    return (kept & ~undecided) | decide_lanes<L>(undecided, [&](unsigned lane) {
             return !is_outside_between(fixed.face, OtherBox<L>(siblings, lane).face, contact, bound.face);
           });
  }

 private:
  static float margin() noexcept { return blocking_margin; }

  /// Whether it reaches into a shaft's box.
  [[nodiscard]] Mask reaches_box(const Siblings& siblings, unsigned lane) const noexcept {
    Mask reaches = reaches_axis(siblings, lane, 0);
    SHAFTCULL_UNROLL(2)
    for (unsigned k = 1; k < 3; ++k) reaches = L::both(reaches, reaches_axis(siblings, lane, k));
    return reaches;
  }
  [[nodiscard]] Mask reaches_axis(const Siblings& siblings, unsigned lane, unsigned k) const noexcept {
    const Vector lo = L::load(&siblings.outer[k][lane]);
    const Vector hi = L::load(&siblings.outer[k + 3][lane]);
    if constexpr (contact == Contact::closed) {
      return L::both(L::less_equal(lo, face_[k + 3]), L::less_equal(face_[k], hi));
    } else {
      const Mask open = L::both(L::less(lo, face_[k + 3]), L::less(face_[k], hi));
      if (bound_.face[k] != bound_.face[k + 3]) [[likely]]
        return open;
      // Both flat: in one plane, or not.
      return L::either(
          open, L::both(L::less_equal(lo, face_[k]), L::both(L::less_equal(face_[k], lo), L::less_equal(hi, lo))));
    }
  }

  /// The largest sum of a constraint from below and one from above on another axis. maximum() passes over a NaN in its
  /// first argument: infinity times 0, of a constraint that is none.
  [[nodiscard]] Vector largest_sum(const Siblings& siblings, unsigned lane) const noexcept {
    Vector since[3];
    Vector until[3];
    const Vector none = L::all(0.0F);
    SHAFTCULL_UNROLL(3)
    for (unsigned k = 0; k < 3; ++k) {
      const Vector lo = L::subtract(L::load(&siblings.inner[k][lane]), face_[k + 3]);
      const Vector hi = L::subtract(face_[k], L::load(&siblings.inner[k + 3][lane]));
      since[k] = L::maximum(L::multiply(lo, L::load(&siblings.backward[k][lane])),
                            L::maximum(L::multiply(hi, L::load(&siblings.forward[k + 3][lane])), none));
      until[k] = L::maximum(L::multiply(lo, L::load(&siblings.forward[k][lane])),
                            L::maximum(L::multiply(hi, L::load(&siblings.backward[k + 3][lane])), none));
    }
    return largest_sum_of_two_axes<L>(since, until);
  }

  const BoxRow& bound_;
  Vector face_[6];
};

/// Siblings of `asked` that keep a bound.
template <class L>
std::uint64_t keep_bound(const Siblings& siblings, const BoxRow& bound, std::uint64_t asked) noexcept {
  bool is_closed = siblings.contact == Contact::closed;
  if (siblings.are_groups) {
    for (unsigned k = 0; k < 3; ++k) is_closed |= bound.face[k] == bound.face[k + 3];
  }
  if (is_closed) return BoundInLanes<L, Contact::closed>(bound).kept(siblings, asked);
  return BoundInLanes<L, Contact::open>(bound).kept(siblings, asked);
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t keep_any(const Siblings& siblings, const BoxRow* bounds, const std::uint32_t* list, std::size_t count,
                       const std::uint64_t* may_keep, std::uint64_t asked) noexcept {
  const std::uint64_t all = asked;
  for (std::size_t i = 0; i != count && asked != 0; ++i) {
    const std::uint64_t lanes = may_keep == nullptr ? asked : asked & may_keep[i];
    if (lanes != 0) asked &= ~keep_bound<L>(siblings, bounds[list[i]], lanes);
  }
  return all & ~asked;
}

/// As SiblingKernels has it.
template <class L>
std::uint64_t keep_siblings(const Siblings& siblings, const BoxRow* bounds, const std::uint32_t* list,
                            std::size_t count, const std::uint64_t* may_keep, std::uint64_t asked,
                            std::uint64_t* kept) noexcept {
  std::uint64_t any = 0;
  for (std::size_t i = 0; i != count; ++i) {
    const std::uint64_t lanes = may_keep == nullptr ? asked : asked & may_keep[i];
    kept[i] = lanes == 0 ? 0 : keep_bound<L>(siblings, bounds[list[i]], lanes);
    any |= kept[i];
  }
  return any;
}

}  // namespace shaftcull::kernel
