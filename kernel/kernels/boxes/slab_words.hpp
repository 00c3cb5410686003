// SPDX-License-Identifier: MIT
/// Words of bounds in the slab form: the loop over whole words, the rest behind them, and undecided words again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "exact/predicates.hpp"
#include "kernels/boxes/bound_corners.hpp"
#include "kernels/boxes/slab_interval.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// An interval length that says outside, for lanes without a bound.
inline constexpr float outside_for_certain = -1.0F;

/// Writes the kept bits of the words from `first` on that `undecided` has a bit for. It makes what it reads of the
/// shaft anew: what the caller has stays in registers, which it would have to store for each call to refer to.
template <class L, ShaftData::SlabForm form, class Words, class Word>
SHAFTCULL_COLD void resolve_slab_words(const ShaftData& shaft, float margin, const float* const* stream,
                                       const Words& position, std::size_t first, std::uint64_t undecided,
                                       const Word& word, std::uint64_t* kept) noexcept {
  const Slab<L, any_uppers, form> slab(shaft, margin, true);
  const BoxCorners<L> corners(shaft, stream);
  for (; undecided != 0; undecided &= undecided - 1) {
    const std::size_t w = first + static_cast<unsigned>(trailing_zeros(undecided));
    const std::size_t at = position(w);
    std::uint64_t outside = 0;
    std::uint64_t near = 0;
    for (unsigned lane = 0; lane < word.bounds; lane += L::width) {
      const auto length =
          word.choose(lane, slab.interval_length([&](unsigned i) { return corners.coordinate(i, word, at, lane); }),
                      L::all(outside_for_certain));
      outside |= L::bits(L::less(length, L::all(0.0F))) << lane;
      near |= L::bits(L::less_equal(length, slab.two_margins)) << lane;
    }
    near &= ~outside;
    if (near != 0) {
      const SlabPredicate exact(shaft);
      outside |=
          decide_lanes<L>(near, [&](unsigned lane) { return exact.outside(BoundAt<L, 6>(stream, at + lane).value); });
    }
    kept[w] = ~outside & word.lanes();
  }
}

/// Writes the kept bits of the word at `at`: exactly, or without the bits of those that are outside for certain.
/// Returns whether a lane is undecided, so that the word's bits mean nothing yet.
template <class L, class SlabType, class Corners, class Word>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline bool slab_word(const SlabType& slab, const Corners& corners,
                                                            std::size_t at, const Word& word,
                                                            std::uint64_t& kept) noexcept {
  std::uint64_t outside = 0;
  if constexpr (SlabType::endless && Corners::exactly) {
    std::uint64_t undecided = 0;
    for (std::size_t four = 0; four < word.bounds; four += 4 * L::width) {
      typename L::Vector length[4];
      typename L::Vector excess[4];
      SHAFTCULL_UNROLL(4)
      for (unsigned v = 0; v < 4; ++v) {
        length[v] = slab.endless_length(
            [&](unsigned i) { return corners.coordinate(i, word, at, four + v * L::width); }, excess[v]);
        length[v] = word.choose(four + v * L::width, length[v], L::all(outside_for_certain));
      }
      const std::uint64_t negative = L::signs(length);
      outside |= negative << four;
      undecided |= L::signs(excess) & ~negative;
    }
    kept = ~outside & word.lanes();
    return undecided != 0;
  }
  typename L::SignCollector signs(slab.two_margins);
  // Of vectors that fill a word four at a time, the compiler sees here that they do.
  for (std::size_t four = 0; four < word_bits && four < word.bounds; four += 4 * L::width) {
    typename L::Vector length[4];
    SHAFTCULL_UNROLL(4)
    for (unsigned v = 0; v < 4; ++v) {
      // Not by way of an object for the vector: with one, g++ 12 does not put four scalar lanes into a register.
      length[v] =
          slab.interval_length([&](unsigned i) { return corners.coordinate(i, word, at, four + v * L::width); });
      if constexpr (Corners::has_radius) {
        length[v] = L::either_negative(length[v], word.load(corners.radius, at, four + v * L::width));
      }
      length[v] = word.choose(four + v * L::width, length[v], L::all(outside_for_certain));
    }
    if constexpr (Corners::exactly) {
      outside |= signs.collect(length) << four;
    } else {
      outside |= L::signs(length) << four;
    }
  }
  kept = ~outside & word.lanes();
  if constexpr (Corners::exactly) {
    return signs.any_undecided();
  } else {
    return false;
  }
}

/// What is not the loop over whole words is compiled for each number of uppers only where calls for few bounds are
/// common: for shafts between two boxes, and boxes and spheres as they come. There it makes them a quarter faster; for
/// all others it would double what a set takes to compile.
template <template <class> class Corners, unsigned uppers, ShaftData::SlabForm form>
inline constexpr unsigned uppers_of_few = (form == ShaftData::SlabForm::fused ||
                                           form == ShaftData::SlabForm::difference)
                                              ? uppers
                                              : any_uppers;
template <unsigned uppers, ShaftData::SlabForm form>
inline constexpr unsigned uppers_of_few<BoxedSphereCorners, uppers, form> = any_uppers;

/// Writes the kept bits of the rest behind whole words, as slab_words(). Apart from those, whose loop would be five
/// times as long with it.
template <class L, template <class> class Corners, unsigned uppers, ShaftData::SlabForm form, class Words>
SHAFTCULL_NOINLINE void slab_rest(const ShaftData& shaft, float margin, const float* const* stream,
                                  const Words& position, std::size_t words, std::uint64_t* kept) noexcept {
  const Slab<L, uppers, form> slab(shaft, margin, Corners<L>::exactly);
  const Corners<L> corners(shaft, stream);
  const PartialWord<L> rest{position.rest};
  const bool is_undecided = slab_word<L>(slab, corners, position(words), rest, kept[words]);
  if constexpr (Corners<L>::exactly) {
    if (is_undecided) [[unlikely]] {
      resolve_slab_words<L, form>(shaft, margin, stream, position, words, 1, rest, kept);
    }
  }
}

/// Writes the kept bits of `words` whole words, and of the rest behind them if there is one: exactly, or clears the
/// bits of those that are outside for certain.
template <class L, template <class> class Corners, class Words, unsigned uppers, ShaftData::SlabForm form>
void slab_words(const ShaftData& shaft, float margin, const float* const* stream, const Words& position,
                std::size_t words, std::uint64_t* kept) noexcept {
  if constexpr (requires { position.rest; }) {
    if (position.rest != 0) {
      slab_rest<L, Corners, uppers_of_few<Corners, uppers, form>, form>(shaft, margin, stream, position, words, kept);
    }
    if (words == 0) return;
  }
  const Slab<L, uppers, form> slab(shaft, margin, Corners<L>::exactly);
  const Corners<L> corners(shaft, stream);
  for (std::size_t first = 0; first < words; first += word_bits) {
    const std::size_t some = words - first < word_bits ? words - first : word_bits;
    std::uint64_t undecided = 0;  // a bit a word
    for (std::size_t w = 0; w < some; ++w) {
      const bool is_undecided = slab_word<L>(slab, corners, position(first + w), WholeWord<L>{}, kept[first + w]);
      undecided |= std::uint64_t{is_undecided} << w;
    }
    if constexpr (Corners<L>::exactly) {
      if (undecided != 0) [[unlikely]] {
        resolve_slab_words<L, form>(shaft, margin, stream, position, first, undecided, WholeWord<L>{}, kept);
      }
    }
  }
}

}  // namespace shaftcull::kernel
