// SPDX-License-Identifier: MIT
/// Tests on a grid: the first stage of many shafts against the same bounds (kernel/kernels/grid/forming.hpp).
#pragma once

#include <cstring>

#include "kernels/boxes/outside_one_by_one.hpp"
#include "kernels/boxes/slab_stages.hpp"
#include "kernels/grid/forming.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Writes `count` bounds' coordinates on the grid, rounded outwards, in whole words. Hi coordinates are negated. The
/// padding of the last word is beyond everything.
template <class L>
void snap_boxes(const GridFrame& frame, const float* const* box, std::size_t count,
                std::int16_t* const* grid) noexcept {
  const auto down = L::all(-snap_slack);  // so that rounding to nearest rounds down
  const auto top = L::all(grid_top);
  const auto bottom = L::Integers16::all(static_cast<std::int16_t>(-grid_top));
  for (unsigned s = 0; s < 6; ++s) {
    const auto origin = L::all(frame.origin[s % 3]);
    const auto steps = L::all(s < 3 ? frame.steps[s % 3] : -frame.steps[s % 3]);
    const auto snap_word = [&](const auto& word, std::size_t at) {
      typename L::Vector snapped[word_bits / L::width];
      for (unsigned v = 0; v < word_bits / L::width; ++v) {
        const std::size_t lane = v * L::width;
        const auto x = L::subtract(word.load(box[s], at, lane), origin);
        snapped[v] = L::minimum(top, L::multiply_add(x, steps, down));
        snapped[v] = word.choose(lane, snapped[v], top);
      }
      L::Integers16::store_rounded(grid[s] + at, snapped, bottom);  // NaN becomes what constrains nothing
    };
    std::size_t i = 0;
    for (; i + word_bits <= count; i += word_bits) snap_word(WholeWord<L>{}, i);
    if (i != count) snap_word(PartialWord<L>{static_cast<unsigned>(count - i)}, i);
  }
}

/// The least lane of some vectors.
template <class S>
[[nodiscard]] std::int16_t least_lane(const typename S::Vector (&of)[S::vectors]) noexcept {
  alignas(64) std::int16_t lane[S::width];
  typename S::Vector all = of[0];
  for (unsigned v = 1; v < S::vectors; ++v) all = S::minimum(all, of[v]);
  static_assert(sizeof(all) == sizeof(lane));
  std::memcpy(lane, &all, sizeof(lane));
  std::int16_t least = lane[0];
  for (unsigned i = 1; i < S::width; ++i) least = lane[i] < least ? lane[i] : least;
  return least;
}

/// Whether some bound of these words has a coordinate that was cut off above, and another one that was not.
template <class L>
SHAFTCULL_NOINLINE [[nodiscard]] bool any_partly_above(const std::int16_t* const* grid, std::size_t words) noexcept {
  constexpr auto top = static_cast<std::int16_t>(grid_top);
  bool any = false;
  for (std::size_t i = 0; i < words * word_bits; ++i) {
    unsigned above = 0;
    for (unsigned s = 0; s < 6; ++s) above += grid[s][i] == top ? 1 : 0;
    any |= above != 0 && above != 6;
  }
  return any;
}

/// As GridKernels has it.
template <class L>
TileExtent tile_extent(const std::int16_t* const* grid, std::size_t words) noexcept {
  using S = typename L::Integers16;
  using Vector = typename S::Vector;
  constexpr auto top = static_cast<std::int16_t>(grid_top);
  TileExtent extent{};
  Vector most[S::vectors];  // of all streams
  for (Vector& each : most) each = S::all(-top);
  for (unsigned s = 0; s < 6; ++s) {
    Vector least[S::vectors];
    for (Vector& each : least) each = S::all(top);
    for (std::size_t i = 0; i < words * word_bits; i += word_bits) {
      SHAFTCULL_UNROLL(8)
      for (unsigned v = 0; v < S::vectors; ++v) {
        const Vector x = S::load(grid[s] + i + v * S::width);
        least[v] = S::minimum(least[v], x);
        most[v] = S::maximum(most[v], x);
      }
    }
    extent.least[s] = least_lane<S>(least);
  }
  for (Vector& each : most) each = S::subtract(S::all(0), each);
  extent.any_above = least_lane<S>(most) == -top && any_partly_above<L>(grid, words);
  return extent;
}

/// Writes the kept bits of `words` words, 0 for bounds that are certainly outside, and lists the words that hold
/// undecided bounds. Returns how many words it lists.
template <class L, unsigned uppers, unsigned stationary>
std::size_t grid_words(const GridShaft& shaft, const std::int16_t* const* grid, std::size_t words, std::uint64_t* kept,
                       std::uint32_t shaft_number, UndecidedWord* undecided) noexcept {
  using S = typename L::Integers16;
  using Vector = typename S::Vector;
  constexpr unsigned moving = 6 - stationary;
  Vector scale[6];
  Vector shift[6];
  const std::int16_t* x[6];
  for (unsigned i = 0; i < 6; ++i) {
    if (i >= 1 && i < moving) scale[i] = S::all(shaft.scale[i]);
    if (i >= 1 || moving == 0) shift[i] = S::all(shaft.shift[i]);
    x[i] = grid[shaft.near_stream[i]];
  }
  const Vector begin = S::all(shaft.begin);
  const Vector end = S::all(shaft.end);
  const Vector limit = S::all(static_cast<std::int16_t>(shaft.limit * 0x0101));

  std::size_t listed = 0;
  for (std::size_t w = 0; w < words; ++w) {
    Vector length[S::vectors];
    SHAFTCULL_UNROLL(8)
    for (unsigned v = 0; v < S::vectors; ++v) {
      const auto coordinate = [&](unsigned i) { return S::load(x[i] + w * word_bits + v * S::width); };
      Vector upper = end;
      Vector lower = moving == 0 ? begin : S::maximum(begin, coordinate(0));
      SHAFTCULL_UNROLL(6)
      for (unsigned i = 1; i < moving; ++i) {
        const Vector t = S::add(S::multiply(coordinate(i), scale[i]), shift[i]);
        if (i <= uppers) {
          upper = S::minimum(upper, t);
        } else {
          lower = S::maximum(lower, t);
        }
      }
      length[v] = S::subtract_saturated(upper, lower);
      SHAFTCULL_UNROLL(6)
      for (unsigned i = moving; i < 6; ++i) length[v] = S::minimum(length[v], S::subtract(shift[i], coordinate(i)));
    }
    const auto outcomes = S::outcomes(length, limit);
    kept[w] = ~outcomes.yes;
    undecided[listed] = {outcomes.undecided, static_cast<std::uint32_t>(w), shaft_number};
    listed += outcomes.undecided != 0 ? 1 : 0;
  }
  return listed;
}

/// As GridKernels has it.
template <class L>
std::size_t test_on_grid(const GridShaft& shaft, const std::int16_t* const* grid, std::size_t words,
                         std::uint64_t* kept, std::uint32_t shaft_number, UndecidedWord* undecided) noexcept {
  using Words = std::size_t(const GridShaft&, const std::int16_t* const*, std::size_t, std::uint64_t*, std::uint32_t,
                            UndecidedWord*) noexcept;
  static constexpr Words* by_stationary_and_uppers[7][6] = {
      {grid_words<L, 0, 0>, grid_words<L, 1, 0>, grid_words<L, 2, 0>, grid_words<L, 3, 0>, grid_words<L, 4, 0>,
       grid_words<L, 5, 0>},
      {grid_words<L, 0, 1>, grid_words<L, 1, 1>, grid_words<L, 2, 1>, grid_words<L, 3, 1>, grid_words<L, 4, 1>},
      {grid_words<L, 0, 2>, grid_words<L, 1, 2>, grid_words<L, 2, 2>, grid_words<L, 3, 2>},
      {grid_words<L, 0, 3>, grid_words<L, 1, 3>, grid_words<L, 2, 3>},
      {grid_words<L, 0, 4>, grid_words<L, 1, 4>},
      {grid_words<L, 0, 5>},
      {grid_words<L, 0, 6>}};
  return by_stationary_and_uppers[shaft.stationary][shaft.uppers](shaft, grid, words, kept, shaft_number, undecided);
}

/// Kept bits of one word of `count` boxes, maybe the last one, by the slab form in floats.
template <class L>
std::uint64_t test_word_in_floats(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                  std::size_t word) noexcept {
  const std::size_t at = word * word_bits;
  if (at + word_bits <= count) return undecided_slab_word<L>(shaft, stream, at, WholeWord<L>{});
  return undecided_slab_word<L>(shaft, stream, at, PartialWord<L>{static_cast<unsigned>(count - at)});
}

/// As GridKernels has it.
template <class L>
void resolve_in_floats(const ShaftData* const* shaft, const float* const* stream, std::size_t count,
                       const UndecidedWord* undecided, std::size_t words, std::uint64_t* const* kept) noexcept {
  for (std::size_t u = 0; u < words; ++u) {
    const ShaftData& its_shaft = *shaft[undecided[u].shaft];
    const std::size_t word = undecided[u].word;
    std::uint64_t& bits = kept[undecided[u].shaft][word];
    const std::uint64_t lanes = undecided[u].lanes & bits;
    if constexpr (L::EightFloats::in_one_register) {
      constexpr int few = 4;  // with more, testing the whole word in vectors is no slower
      if (popcount(lanes) <= few && SlabInLanes<L>::suits(its_shaft)) {
        bits &= ~outside_one_by_one<L>(its_shaft, stream, word * word_bits, lanes);
        continue;
      }
      if (popcount(lanes) <= few && EndlessSlabInLanes<L>::suits(its_shaft)) {
        bits &= ~outside_one_by_one<L, EndlessSlabInLanes<L>>(its_shaft, stream, word * word_bits, lanes);
        continue;
      }
    }
    bits &= test_word_in_floats<L>(its_shaft, stream, count, word) | ~lanes;
  }
}

}  // namespace shaftcull::kernel
