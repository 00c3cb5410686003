// SPDX-License-Identifier: MIT
/// Bounds outside the shaft, in slab form: is there a t between box a's and box b's that satisfies all six constraints?
#pragma once

#include <cstddef>
#include <cstdint>

#include "exact/predicates.hpp"
#include "kernels/boxes/bound_corners.hpp"
#include "kernels/boxes/slab_words.hpp"
#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// Of some lanes of the word at `at` those that are kept.
template <class L>
std::uint64_t exactly_kept(const SlabPredicate& exact, const float* const* stream, std::size_t at,
                           std::uint64_t lanes) noexcept {
  return lanes &
         ~decide_lanes<L>(lanes, [&](unsigned lane) { return exact.outside(BoundAt<L, 6>(stream, at + lane).value); });
}

/// For shafts that no margin holds for.
template <class L, class Words>
void box_exact_words(const ShaftData& shaft, const float* const* stream, const Words& position, std::size_t words,
                     std::uint64_t* kept) noexcept {
  const SlabPredicate exact(shaft);
  for (std::size_t w = 0; w < words; ++w) kept[w] = exactly_kept<L>(exact, stream, position(w), ~std::uint64_t{0});
  if constexpr (requires { position.rest; }) {
    if (position.rest != 0) kept[words] = exactly_kept<L>(exact, stream, position(words), first_bits(position.rest));
  }
}

/// Calls Test::run<uppers, form> with what suits a shaft: its form, and how many constraints bound t from above. In the
/// fused form the reference face's always does. Spheres are tested in the fused and the endless form alone
/// (outside_needs_planes()).
template <class Test, class... Arguments>
void with_slab_of(const ShaftData& shaft, Arguments... arguments) noexcept {
  using enum ShaftData::SlabForm;
  using Run = void(const ShaftData&, Arguments...) noexcept;
  if constexpr (Test::exactly) {
    if (shaft.slab_form == relative) return Test::template run<any_uppers, relative>(shaft, arguments...);
    static constexpr Run* difference_by_uppers[7] = {
        Test::template run<0, difference>, Test::template run<1, difference>, Test::template run<2, difference>,
        Test::template run<3, difference>, Test::template run<4, difference>, Test::template run<5, difference>,
        Test::template run<6, difference>};
    if (shaft.slab_form == difference) return difference_by_uppers[shaft.slab_uppers](shaft, arguments...);
  }
  // A box that moves without end has a face that bounds t from above, and one that bounds it from below.
  static constexpr Run* endless_by_uppers[7] = {nullptr,
                                                Test::template run<1, endless>,
                                                Test::template run<2, endless>,
                                                Test::template run<3, endless>,
                                                Test::template run<4, endless>,
                                                Test::template run<5, endless>,
                                                nullptr};
  if (shaft.slab_form == endless) return endless_by_uppers[shaft.slab_uppers](shaft, arguments...);
  static constexpr Run* fused_by_uppers[7] = {nullptr,
                                              Test::template run<1, fused>,
                                              Test::template run<2, fused>,
                                              Test::template run<3, fused>,
                                              Test::template run<4, fused>,
                                              Test::template run<5, fused>,
                                              Test::template run<6, fused>};
  fused_by_uppers[shaft.slab_uppers](shaft, arguments...);
}

/// Words of a stream, most of which hold no bound that is undecided.
template <class L, template <class> class Corners, class Words>
struct TestSlabWords {
  static constexpr bool exactly = Corners<L>::exactly;

  /// Itself, not a function that calls it: that takes a sixth of a call for one word.
  template <unsigned uppers, ShaftData::SlabForm form>
  static constexpr auto* run = slab_words<L, Corners, Words, uppers, form>;
};

/// First stage of the slab form: writes the kept bits of `words` whole words, and of the rest behind them if there is
/// one.
template <class L, class Words = ConsecutiveWords<L>>
void box_slab_stage(const ShaftData& shaft, const float* const* stream, std::size_t words, std::uint64_t* kept,
                    const Words& position = {}) noexcept {
  if (shaft.slab_form == ShaftData::SlabForm::exact) [[unlikely]] {
    return box_exact_words<L>(shaft, stream, position, words, kept);
  }
  with_slab_of<TestSlabWords<L, BoxCorners, Words>, float, const float* const*, const Words&>(
      shaft, shaft.slab_margin, stream, position, words, kept);
}

/// The kept bits of one word of boxes at `at`, of which some are probably undecided.
template <class L, class Word>
std::uint64_t undecided_slab_word(const ShaftData& shaft, const float* const* stream, std::size_t at,
                                  const Word& word) noexcept {
  using enum ShaftData::SlabForm;
  if (shaft.slab_form == exact) [[unlikely]] {
    const SlabPredicate exact(shaft);
    return exactly_kept<L>(exact, stream, at, word.lanes());
  }
  std::uint64_t kept;
  const auto resolve = [&]<ShaftData::SlabForm form>() {
    resolve_slab_words<L, form>(shaft, shaft.slab_margin, stream, ConsecutiveWords<L>{.first = at}, 0, 1, word, &kept);
  };
  switch (shaft.slab_form) {
    case relative:
      resolve.template operator()<relative>();
      break;
    case difference:
      resolve.template operator()<difference>();
      break;
    case endless:
      resolve.template operator()<endless>();
      break;
    default:
      resolve.template operator()<fused>();
      break;
  }
  return kept;
}

/// Likewise for spheres, or boxes around them, and a shaft in the fused or the endless form: clears the bits of those
/// that are outside for certain. Their corners are rounded once more than those of boxes: 22 and 14 units instead of 20
/// and 12 (docs/exactness.md).
template <class L, template <class> class Corners, class Words = ConsecutiveWords<L>>
void sphere_slab_stage(const ShaftData& shaft, const float* const* stream, std::size_t words, std::uint64_t* kept,
                       const Words& position = {}) noexcept {
  constexpr float wider = 1.17F;
  with_slab_of<TestSlabWords<L, Corners, Words>, float, const float* const*, const Words&>(
      shaft, wider * shaft.slab_margin, stream, position, words, kept);
}

}  // namespace shaftcull::kernel
