/// Tests on a grid: the first stage of many shafts against the same bounds (kernel/compile/grid.hpp).
#pragma once

#include "compile/grid.hpp"
#include "simd/float_environment.hpp"
#include "test/box_slab.hpp"
#include "test/word.hpp"

namespace shaftcull::kernel {

/// Writes `words` words of bounds' coordinates on the grid, rounded outwards: hi coordinates are negated.
template <class L>
void snap_boxes(const GridFrame& frame, const float* const* box, std::size_t words, std::int16_t* const* grid) noexcept {
  const FloatEnvironment<L> environment;
  const auto down = L::all(-snap_slack * grid_slack_factor);  // so that rounding to nearest rounds down
  const auto top = L::all(0x1p15F);
  for (unsigned s = 0; s < 6; ++s) {
    const auto origin = L::all(frame.origin[s % 3]);
    const auto steps = L::all(s < 3 ? frame.steps[s % 3] : -frame.steps[s % 3]);
    for (std::size_t i = 0; i < words * word_bits; i += word_bits) {
      typename L::Vector snapped[word_bits / L::width];
      for (unsigned v = 0; v < word_bits / L::width; ++v) {
        const auto x = L::subtract(L::load(box[s] + i + v * L::width), origin);
        snapped[v] = L::minimum(top, L::multiply_add(x, steps, down));  // NaN stays NaN, and is stored as what constrains nothing
      }
      L::Shorts::store_word(grid[s] + i, snapped);
    }
  }
}

/// Writes the kept bits of `words` words, 0 for bounds that are certainly outside, and lists the words that hold bounds which may be either.
/// Returns how many those are.
template <class L, unsigned uppers, unsigned standing>
std::size_t grid_words(const GridShaft& shaft, const std::int16_t* const* grid, std::size_t words, std::uint64_t* kept,
                       std::uint32_t* undecided) noexcept {
  using S = typename L::Shorts;
  using Vector = typename S::Vector;
  Vector scale[6];
  Vector shift[6];
  const std::int16_t* x[6];
  for (unsigned i = 0; i < 6; ++i) {
    scale[i] = S::all(shaft.scale[i]);
    shift[i] = S::all(shaft.shift[i]);
    x[i] = grid[shaft.near_stream[i]];
  }
  const Vector begin = S::all(shaft.begin);
  const Vector end = S::all(shaft.end);
  const Vector limit = S::all(static_cast<std::int16_t>(shaft.limit * 0x0101));

  std::size_t listed = 0;
  for (std::size_t w = 0; w < words; ++w) {
    Vector room[S::vectors];
#pragma GCC unroll 8
    for (unsigned v = 0; v < S::vectors; ++v) {
      const auto product = [&](unsigned i) { return S::multiply(S::load(x[i] + w * word_bits + v * S::width), scale[i]); };
      Vector upper = end;
      Vector lower = begin;
#pragma GCC unroll 6
      for (unsigned i = 0; i < 6 - standing; ++i) {
        const Vector t = S::add(product(i), shift[i]);
        if (i < uppers) {
          upper = S::minimum(upper, t);
        } else {
          lower = S::maximum(lower, t);
        }
      }
      room[v] = S::subtract_saturated(upper, lower);
#pragma GCC unroll 6
      for (unsigned i = 6 - standing; i < 6; ++i) room[v] = S::minimum(room[v], S::subtract(shift[i], product(i)));
    }
    const auto outcomes = S::outcomes(room, limit);
    kept[w] = ~outcomes.yes;
    undecided[listed] = static_cast<std::uint32_t>(w);
    listed += outcomes.any_undecided ? 1 : 0;
  }
  return listed;
}

template <class L>
std::size_t grid_words_of(const GridShaft& shaft, const std::int16_t* const* grid, std::size_t words, std::uint64_t* kept,
                          std::uint32_t* undecided) noexcept {
  using Words = std::size_t(const GridShaft&, const std::int16_t* const*, std::size_t, std::uint64_t*, std::uint32_t*) noexcept;
  static constexpr Words* by_standing_and_uppers[7][7] = {
      {grid_words<L, 0, 0>, grid_words<L, 1, 0>, grid_words<L, 2, 0>, grid_words<L, 3, 0>, grid_words<L, 4, 0>, grid_words<L, 5, 0>,
       grid_words<L, 6, 0>},
      {grid_words<L, 0, 1>, grid_words<L, 1, 1>, grid_words<L, 2, 1>, grid_words<L, 3, 1>, grid_words<L, 4, 1>, grid_words<L, 5, 1>},
      {grid_words<L, 0, 2>, grid_words<L, 1, 2>, grid_words<L, 2, 2>, grid_words<L, 3, 2>, grid_words<L, 4, 2>},
      {grid_words<L, 0, 3>, grid_words<L, 1, 3>, grid_words<L, 2, 3>, grid_words<L, 3, 3>},
      {grid_words<L, 0, 4>, grid_words<L, 1, 4>, grid_words<L, 2, 4>},
      {grid_words<L, 0, 5>, grid_words<L, 1, 5>},
      {grid_words<L, 0, 6>}};
  return by_standing_and_uppers[shaft.standing][shaft.uppers](shaft, grid, words, kept, undecided);
}

/// First stage of box tests on a grid: writes the kept bits of a block of words.
template <class L>
void box_grid_stage(const CompiledShaft& shaft, const GridShaft& on_grid, const std::int16_t* const* grid,
                    const float* const* stream, std::size_t words, std::uint64_t* kept) noexcept {
  std::uint32_t undecided[block_words];
  const std::size_t listed = grid_words_of<L>(on_grid, grid, words, kept, undecided);
  if (listed == 0) return;
  std::uint64_t decided[block_words];
  const auto position = [&](std::size_t i) { return std::size_t{undecided[i]} * word_bits; };
  box_slab_stage<L>(shaft, stream, listed, decided, position);
  for (std::size_t i = 0; i < listed; ++i) kept[undecided[i]] = decided[i];
}

/// Likewise for boxes around spheres, whose bits are 0 only if they are certainly outside.
template <class L>
void sphere_grid_stage(const GridShaft& on_grid, const std::int16_t* const* grid, std::size_t words, std::uint64_t* kept) noexcept {
  std::uint32_t undecided[block_words];  // later stages look at all that are left anyway
  grid_words_of<L>(on_grid, grid, words, kept, undecided);
}

}  // namespace shaftcull::kernel
