// SPDX-License-Identifier: MIT
/// Boxes inside the shaft, one box at a time: the lanes of a vector hold the planes of the shaft. For few boxes that
/// lie apart.
#pragma once

#include <cmath>

#include "exact/predicates.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// The faces and joining planes of a shaft in eight lanes.
template <class L>
class PlanesInLanes {
 public:
  using EightFloats = typename L::EightFloats;
  using Vector = typename EightFloats::Vector;

  /// Whether these planes are all that the shaft has, and their margin is finite.
  [[nodiscard]] static bool suits(const ShaftData& shaft) noexcept {
    return shaft.added_count == 0 && shaft.joining_margin < INFINITY;
  }

  PlanesInLanes(const ShaftData& shaft, const float* const* stream) noexcept
      : corner0_(EightFloats::order(shaft.joining_far0)),
        corner1_(EightFloats::order(shaft.joining_far1)),
        faces_(EightFloats::negate_hi(EightFloats::load_six(shaft.face, -INFINITY))),
        two_margins_(2 * shaft.joining_margin) {
    for (unsigned s = 0; s < 6; ++s) stream_[s] = stream[s];
    // Unused lanes have a plane whose value is −∞, so that every box is behind it. For boxes with an infinite
    // coordinate it is NaN, but those are not within the faces.
    const auto exists = EightFloats::first(shaft.joining_count);
    const Vector shift =
        EightFloats::add(EightFloats::load(shaft.joining_minus_offset), EightFloats::all(shaft.joining_margin));
    normal0_ = EightFloats::choose(exists, EightFloats::load(shaft.joining_normal0), EightFloats::all(0.0F));
    normal1_ = EightFloats::choose(exists, EightFloats::load(shaft.joining_normal1), EightFloats::all(0.0F));
    shift_ = EightFloats::choose(exists, shift, EightFloats::all(-INFINITY));
  }

  /// Values of a box, lane by lane.
  struct Verdict {
    typename EightFloats::Mask
        within;    ///< its faces are within the shaft box's; and, in the last lanes, it is not empty
    Vector value;  ///< of planes at the far corner + margin: negative if certainly behind, above two margins if
                   ///< certainly beyond
  };
  [[nodiscard]] Verdict of(std::size_t i) const noexcept {
    const Vector box = EightFloats::gather(stream_, i);
    const Vector lower = EightFloats::with_seventh(faces_, EightFloats::all(stream_[0][i]));
    return {
        EightFloats::less_equal(lower, EightFloats::negate_hi(box)),
        EightFloats::multiply_add(EightFloats::permuted(box, corner0_), normal0_,
                                  EightFloats::multiply_add(EightFloats::permuted(box, corner1_), normal1_, shift_))};
  }
  /// Lanes whose value is neither certainly behind nor certainly beyond.
  [[nodiscard]] unsigned undecided(Vector value) const noexcept {
    return EightFloats::signs(EightFloats::less_equal(value, EightFloats::all(two_margins_))) &
           ~EightFloats::signs(value);
  }

 private:
  typename EightFloats::Order corner0_;
  typename EightFloats::Order corner1_;
  Vector normal0_;
  Vector normal1_;
  Vector shift_;
  Vector faces_;
  const float* stream_[6];
  float two_margins_;
};

inline constexpr unsigned all_eight = 0xff;

/// Writes which of the boxes at `positions` are inside, where some are undecided.
template <class L>
SHAFTCULL_COLD void resolve_inside_one_by_one(const ShaftData& shaft, const PlanesInLanes<L>& planes,
                                              const float* const* stream, std::size_t words,
                                              const Positions<L>& positions, std::uint64_t* inside) noexcept {
  using EightFloats = typename L::EightFloats;
  std::uint64_t undecided[most_block_words];
  for (std::size_t w = 0; w < words; ++w) inside[w] = undecided[w] = 0;
  for (unsigned k = 0; k < positions.count(); ++k) {
    const unsigned i = positions[k];
    const auto verdict = planes.of(i);
    if (EightFloats::signs(verdict.within) != all_eight) continue;
    const unsigned behind = EightFloats::signs(verdict.value);
    const std::uint64_t bit = std::uint64_t{1} << (i % word_bits);
    if (behind == all_eight) {
      inside[i / word_bits] |= bit;
    } else if ((behind | planes.undecided(verdict.value)) == all_eight) {
      undecided[i / word_bits] |= bit;
    }
  }
  for (std::size_t w = 0; w < words; ++w) {
    if (undecided[w] == 0) continue;
    inside[w] |= decide_lanes<L>(undecided[w], [&](unsigned lane) {
      return box_inside(shaft, BoundAt<L, 6>(stream, w * word_bits + lane).value);
    });
  }
}

/// Writes which of the kept boxes, few of them, are inside of a shaft that PlanesInLanes suits.
template <class L>
void box_inside_one_by_one_stage(const ShaftData& shaft, const float* const* stream, std::size_t words,
                                 const std::uint64_t* kept, std::uint64_t* inside) noexcept {
  using EightFloats = typename L::EightFloats;
  const PlanesInLanes<L> planes(shaft, stream);
  const Positions<L> positions(kept, words);
  for (std::size_t w = 0; w < words; ++w) inside[w] = 0;
  auto least = EightFloats::all(-1.0F);
  for (unsigned k = 0; k < positions.count(); ++k) {
    const unsigned i = positions[k];
    const auto verdict = planes.of(i);
    least = EightFloats::minimum_of_bits(least, verdict.value);
    const unsigned signs = EightFloats::signs(EightFloats::both(verdict.within, verdict.value));
    inside[i / word_bits] |= std::uint64_t{(signs + 1) / (all_eight + 1)} << (i % word_bits);
  }
  if (planes.undecided(least) != 0) [[unlikely]]
    resolve_inside_one_by_one<L>(shaft, planes, stream, words, positions, inside);
}

}  // namespace shaftcull::kernel
