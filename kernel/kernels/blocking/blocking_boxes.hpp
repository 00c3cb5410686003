// SPDX-License-Identifier: MIT
/// Boxes that block a shaft: boxes that every segment from its one end to the other passes through.
///
/// Such a box satisfies lo(t) > box.lo and hi(t) < box.hi for all pairs of constraints on different axes, and on every
/// axis it reaches across: box.lo is less than all coordinates of one end's relative interior, and box.hi greater
/// (docs/exactness.md). Comparisons decide the second part, exactly, and leave few boxes.
#pragma once

#include <cmath>
#include <type_traits>

#include "exact/blocking.hpp"
#include "kernels/boxes/slab_stages.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/shared/two_axes.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/tree/listed_words.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// What is asked.
enum class OcclusionQuestion : std::uint8_t {
  boxes,             ///< which boxes block the shaft
  boxes_in_a_plane,  ///< likewise, of a shaft that is flat: flat boxes in its plane may block it
  nodes,             ///< which boxes may hold one that blocks it
};

/// Relative error of a sum of two parameters: five roundings, and one more to spare.
inline constexpr float blocking_margin = 6 * 0x1p-24F;

/// Whether the reciprocal of a face's travel is a float with all its bits.
template <class L>
bool has_reciprocal(float travel) noexcept {
  const float length = fabsf(travel);
  return length >= 0x1p-126F && length <= 0x1p126F;
}

/// The least float that is no less than all coordinates from lo to hi, and for lo < hi between them: a float is less
/// than this one iff it is less than all of these.
template <class L>
float limit_of_lo(float lo, float hi) noexcept {
  if (!(lo < hi)) return lo;
  const float zeros_joined = lo + 0.0F;
  const auto bits = __builtin_bit_cast(std::uint32_t, zeros_joined);
  return __builtin_bit_cast(float, zeros_joined < 0 ? bits - 1 : bits + 1);
}

/// Whether the shaft's two boxes lie in one plane across an axis.
template <class L>
bool is_in_a_plane(const ShaftData& shaft) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (shaft.a[k] == shaft.a[k + 3] && shaft.a[k] == shaft.b[k] && shaft.a[k] == shaft.b[k + 3]) return true;
  }
  return false;
}

/// A shaft's constraints in registers.
///
/// A constraint that bounds t from below has `since` = (x − a's face) / travel, which t exceeds; one that bounds it
/// from above has `until` = (b's face − x) / travel, which 1 − t exceeds. No t is left for both if their sum is 1 or
/// more. Constraints that are satisfied for all t have negative values, which count as 0.
template <class L, OcclusionQuestion question>
class OcclusionConstraints {
  using Vector = typename L::Vector;
  using Mask = typename L::Mask;

 public:
  explicit OcclusionConstraints(const ShaftData& shaft) noexcept : shaft_(shaft) {
    bool is_exact = false;
    float base[6];
    float since[6];
    float until[6];
    for (unsigned f = 0; f < 6; ++f) {
      const float travel = shaft.b[f] - shaft.a[f];
      const bool from_below = (travel > 0) == (f < 3);
      base[f] = from_below ? shaft.a[f] : shaft.b[f];
      since[f] = until[f] = 0;
      if (travel == 0) continue;
      if (!has_reciprocal<L>(travel)) is_exact = true;
      (from_below ? since : until)[f] = (from_below ? 1.0F : -1.0F) / travel;
    }
    for (unsigned f = 0; f < 6; ++f) {
      base_[f] = L::all(base[f]);
      since_[f] = L::all(is_exact ? 0 : since[f]);
      until_[f] = L::all(is_exact ? 0 : until[f]);
    }
    for (unsigned k = 0; k < 3; ++k) {
      const float a_lo = limit_of_lo<L>(shaft.a[k], shaft.a[k + 3]);
      const float b_lo = limit_of_lo<L>(shaft.b[k], shaft.b[k + 3]);
      const float a_hi = -limit_of_lo<L>(-shaft.a[k + 3], -shaft.a[k]);
      const float b_hi = -limit_of_lo<L>(-shaft.b[k + 3], -shaft.b[k]);
      largest_lo_[k] = L::all(a_lo > b_lo ? a_lo : b_lo);
      smallest_hi_[k] = L::all(a_hi < b_hi ? a_hi : b_hi);
    }
    // Where floats would overflow, nothing is certain.
    certain_ = L::all(is_exact ? -1.0F : 1 - blocking_margin);
    possible_ = L::all(1 + blocking_margin);
  }
  OcclusionConstraints(const OcclusionConstraints&) = delete;
  OcclusionConstraints& operator=(const OcclusionConstraints&) = delete;

  /// Bits of the boxes of the word at `at` for which the question is to be answered yes.
  template <class Word>
  [[nodiscard]] std::uint64_t bits(const float* const* stream, std::size_t at, const Word& word) const noexcept {
    std::uint64_t across = 0;
    for (unsigned lane = 0; lane < word.bounds; lane += L::width) {
      across |= L::bits(reaches_across(stream, at, word, lane)) << lane;
    }
    across &= word.lanes();  // a vector may have more lanes than there are bounds left
    if (across == 0) return 0;
    return of_those_across(stream, at, word, across);
  }

 private:
  static constexpr bool closed = question != OcclusionQuestion::boxes;

  [[nodiscard]] static Mask before(Vector x, Vector y) noexcept { return closed ? L::less_equal(x, y) : L::less(x, y); }

  template <class Word>
  [[nodiscard]] Mask reaches_across(const float* const* stream, std::size_t at, const Word& word,
                                    unsigned lane) const noexcept {
    Mask across = L::both(before(word.load(stream[0], at, lane), largest_lo_[0]),
                          before(smallest_hi_[0], word.load(stream[3], at, lane)));
    SHAFTCULL_UNROLL(2)
    for (unsigned k = 1; k < 3; ++k) {
      across = L::both(across, L::both(before(word.load(stream[k], at, lane), largest_lo_[k]),
                                       before(smallest_hi_[k], word.load(stream[k + 3], at, lane))));
    }
    return across;
  }

  /// Likewise, where some box reaches across the shaft on all axes.
  template <class Word>
  SHAFTCULL_NOINLINE [[nodiscard]] std::uint64_t of_those_across(const float* const* stream, std::size_t at,
                                                                 const Word& word,
                                                                 std::uint64_t across) const noexcept {
    std::uint64_t certain = 0;
    std::uint64_t possible = 0;
    for (unsigned lane = 0; lane < word.bounds; lane += L::width) {
      if ((across & lanes_of<L>(lane)) == 0) continue;
      Vector box[6];
      SHAFTCULL_UNROLL(6)
      for (unsigned f = 0; f < 6; ++f) box[f] = word.load(stream[f], at, lane);
      const Vector sum = largest_sum(box);
      Mask may = L::less_equal(sum, possible_);
      Mask does = L::less(sum, certain_);
      if constexpr (question != OcclusionQuestion::nodes) {
        SHAFTCULL_UNROLL(3)
        for (unsigned k = 0; k < 3; ++k) {
          may = L::both(may, L::less_equal(box[k], box[k + 3]));
          if constexpr (closed) {
            does = L::both(does, L::both(L::less(box[k], largest_lo_[k]), L::less(smallest_hi_[k], box[k + 3])));
          }
        }
      }
      possible |= L::bits(may) << lane;
      certain |= L::bits(does) << lane;
    }
    possible &= across;
    if constexpr (question == OcclusionQuestion::nodes) return possible;
    certain &= possible;
    if (possible == certain) return certain;
    return certain | decide_lanes<L>(possible & ~certain, [&](unsigned lane) {
             return box_blocks(shaft_, BoundAt<L, 6>(stream, at + lane).value);
           });
  }

  /// The largest sum of a constraint from below and one from above on another axis. Never NaN: maximum passes over a
  /// NaN in its first argument.
  [[nodiscard]] Vector largest_sum(const Vector (&box)[6]) const noexcept {
    Vector since[3];
    Vector until[3];
    SHAFTCULL_UNROLL(3)
    for (unsigned k = 0; k < 3; ++k) {
      const Vector lo = L::subtract(box[k], base_[k]);
      const Vector hi = L::subtract(box[k + 3], base_[k + 3]);
      const Vector none = L::all(0.0F);
      since[k] = L::maximum(L::multiply(lo, since_[k]), L::maximum(L::multiply(hi, since_[k + 3]), none));
      until[k] = L::maximum(L::multiply(lo, until_[k]), L::maximum(L::multiply(hi, until_[k + 3]), none));
    }
    return largest_sum_of_two_axes<L>(since, until);
  }

  const ShaftData& shaft_;
  Vector largest_lo_[3];
  Vector smallest_hi_[3];
  Vector base_[6];
  Vector since_[6];
  Vector until_[6];
  Vector certain_;
  Vector possible_;
};

/// Writes the bits of `words` whole words, and of the rest behind them if there is one.
template <class L, OcclusionQuestion question, class Words>
void blocking_words(const ShaftData& shaft, const float* const* stream, const Words& position, std::size_t words,
                    std::uint64_t* blocking) noexcept {
  const OcclusionConstraints<L, question> constraints(shaft);
  for (std::size_t w = 0; w < words; ++w) blocking[w] = constraints.bits(stream, position(w), WholeWord<L>{});
  if constexpr (requires { position.rest; }) {
    if (position.rest == 0) return;
    blocking[words] = constraints.bits(stream, position(words), PartialWord<L>{position.rest});
  }
}

/// Bits of the boxes of a word that may block a hull between two ends: those that reach across it on each axis, and
/// meet the middle of the ends.
template <class L, class Word>
[[nodiscard]] std::uint64_t may_block_hull(const HullData& hull, const float* const* stream, std::size_t at,
                                           const Word& word) noexcept {
  std::uint64_t across = 0;
  for (unsigned lane = 0; lane < word.bounds; lane += L::width) {
    const auto on_axis = [&](unsigned k) {
      return L::both(L::less_equal(word.load(stream[k], at, lane), L::all(hull.across[k])),
                     L::less_equal(L::all(hull.across[k + 3]), word.load(stream[k + 3], at, lane)));
    };
    across |= L::bits(L::both(on_axis(0), L::both(on_axis(1), on_axis(2)))) << lane;
  }
  across &= word.lanes();
  if (across == 0) return 0;
  constexpr bool is_whole = std::is_same_v<Word, WholeWord<L>>;
  ConsecutiveWords<L> position{.first = at};
  if constexpr (!is_whole) position.rest = word.bounds;
  std::uint64_t kept = 0;
  box_slab_stage<L>(*hull.middle, stream, is_whole ? 1 : 0, &kept, position);
  return across & kept;
}

/// Writes the bits of words of boxes that block a hull between two ends, or of nodes that may hold such boxes.
template <class L, OcclusionQuestion question, class Words>
SHAFTCULL_NOINLINE void hull_blocking_words(const ShaftData& shaft, const float* const* stream, const Words& position,
                                            std::size_t words, std::uint64_t* blocking) noexcept {
  const auto bits = [&](std::size_t at, const auto& word) {
    const std::uint64_t may = may_block_hull<L>(*shaft.hull, stream, at, word);
    if (question == OcclusionQuestion::nodes || may == 0) return may;
    return decide_lanes<L>(may,
                           [&](unsigned lane) { return box_blocks(shaft, BoundAt<L, 6>(stream, at + lane).value); });
  };
  for (std::size_t w = 0; w < words; ++w) blocking[w] = bits(position(w), WholeWord<L>{});
  if constexpr (requires { position.rest; }) {
    if (position.rest != 0) blocking[words] = bits(position(words), PartialWord<L>{position.rest});
  }
}

/// Likewise, of boxes.
template <class L, class Words>
void blocking_boxes(const ShaftData& shaft, const float* const* stream, const Words& position, std::size_t words,
                    std::uint64_t* blocking) noexcept {
  if (shaft.is_hull()) [[unlikely]]
    return hull_blocking_words<L, OcclusionQuestion::boxes>(shaft, stream, position, words, blocking);
  if (is_in_a_plane<L>(shaft)) {
    blocking_words<L, OcclusionQuestion::boxes_in_a_plane>(shaft, stream, position, words, blocking);
  } else {
    blocking_words<L, OcclusionQuestion::boxes>(shaft, stream, position, words, blocking);
  }
}

// As OcclusionKernels has them.

template <class L>
void test_blocking(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* blocking,
                   std::uint64_t* /*inside*/) noexcept {
  const ConsecutiveWords<L> position{.rest = static_cast<unsigned>(count % word_bits)};
  blocking_boxes<L>(shaft, stream, position, count / word_bits, blocking);
}

template <class L>
void test_blocking_listed(const ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                          std::size_t words, std::uint64_t* blocking, std::uint64_t* /*inside*/,
                          unsigned /*least_kept*/) noexcept {
  blocking_boxes<L>(shaft, stream, ListedWords<L>{word}, words, blocking);
}

template <class L>
void test_blocking_nodes(const ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                         std::size_t words, std::uint64_t* blocking, std::uint64_t* /*inside*/,
                         unsigned /*least_kept*/) noexcept {
  if (shaft.is_hull()) [[unlikely]]
    return hull_blocking_words<L, OcclusionQuestion::nodes>(shaft, stream, ListedWords<L>{word}, words, blocking);
  blocking_words<L, OcclusionQuestion::nodes>(shaft, stream, ListedWords<L>{word}, words, blocking);
}

}  // namespace shaftcull::kernel
