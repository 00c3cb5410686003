/// Words: 64 bounds at a time, and what every stage of a test shares.
///
/// A test is a row of stages over a block of words. Each stage sees the kept bits of the one before and only clears some.
/// A stage that cannot decide a lane for certain asks an exact predicate for that lane, so between stages every bit is
/// the real-arithmetic answer.
#pragma once

#ifdef __BMI__
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"
#include "mutant.hpp"

namespace shaftcull::kernel {

inline constexpr unsigned word_bits = 64;

/// Words in a block: stages after the first find 2,048 bounds still in the cache.
inline constexpr std::size_t block_words = 32;

/// The lanes of one vector within a word.
template <class L>
constexpr std::uint64_t lanes_of(unsigned offset) noexcept {
  return (L::width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << L::width) - 1) << offset;
}

/// Position of the lowest bit that is set; 63 or 64 if none is.
template <class L>
unsigned lowest_bit(std::uint64_t word) noexcept {
#ifdef __BMI__
  return static_cast<unsigned>(_tzcnt_u64(word));
#else
  return static_cast<unsigned>(__builtin_ctzll(word | std::uint64_t{1} << 63));
#endif
}

/// Calls decide(lane) for every bit of `lanes`, and returns the bits for which it was true. A vector type that wants to
/// know how often floats are not enough has a note_undecided().
template <class L, class Decide>
[[gnu::noinline, gnu::cold]] std::uint64_t decide_lanes(std::uint64_t lanes, Decide decide) noexcept {
  if constexpr (requires { L::note_undecided(lanes); }) L::note_undecided(lanes);
  if (drops_exact_step) return 0;
  std::uint64_t yes = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctzll(lanes));
    if (decide(lane)) yes |= std::uint64_t{1} << lane;
  }
  return yes;
}

/// Bound `i` of `streams` separate streams, as the exact predicates take it.
template <class L, unsigned streams>
struct BoundAt {
  float value[streams];

  BoundAt(const float* const* stream, std::size_t i) noexcept {
    for (unsigned s = 0; s < streams; ++s) value[s] = stream[s][i];
  }
};

}  // namespace shaftcull::kernel
