/// Halving entries of a bounds tree: one pass without a branch that depends on a key.
#pragma once

#include "simd/float_environment.hpp"
#include "test/pivot.hpp"

namespace shaftcull::kernel {

/// Floats ahead of those read or written that are fetched. Processors foresee reads, but not these writes: without it
/// parts that the L2 cache holds take half as long again.
inline constexpr std::size_t ahead = 48;

/// Keeps the `low` entries whose key is below the limit in `from`, and moves the others to `to`, from place `low` on.
template <class L, unsigned streams>
void part_by(float* const* from, float* const* to, std::size_t count, unsigned axis, float limit,
             std::size_t low) noexcept {
  const auto limits = L::all(limit);
  std::size_t kept = 0;
  std::size_t moved = low;
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    const std::uint64_t is_low = L::bits(L::less(L::load(from[axis] + i), limits));
    const typename L::Packing low_ones(is_low);
    const typename L::Packing high_ones(~is_low & lanes_of<L>(0));
    const auto lows = static_cast<std::size_t>(__builtin_popcountll(is_low));
    const bool has_room = moved + L::width <= count;
    for (unsigned s = 0; s < streams; ++s) {
      __builtin_prefetch(to[s] + moved + ahead, 1);
      __builtin_prefetch(from[s] + kept + ahead, 1);
      __builtin_prefetch(from[s] + i + ahead);
      const auto x = L::load(from[s] + i);
      low_ones.store(from[s] + kept, x);  // what was there has been read
      if (has_room) {
        high_ones.store(to[s] + moved, x);
      } else {
        high_ones.store(to[s] + moved, x, L::width - lows);
      }
    }
    kept += lows;
    moved += L::width - lows;
  }
  for (; i < count; ++i) {
    const bool is_low = from[axis][i] < limit;
    for (unsigned s = 0; s < streams; ++s) {
      const float x = from[s][i];
      *(is_low ? from[s] + kept : to[s] + moved) = x;
    }
    ++(is_low ? kept : moved);
  }
}

/// As SplitEntries in kernels.hpp.
template <class L, unsigned streams>
void split_entries(float* const* from, float* const* to, std::size_t count, std::size_t first_half) noexcept {
  const FloatEnvironment<L> environment;
  constexpr std::size_t few = 4096;  // the same for all, since the axis depends on it
  const Halving halving = count <= few ? halving_of_few<L>(from, count, first_half)
                                       : halving_of_many<L>(from, count, first_half, to);
  const auto [key, less] = halving.pivot;
  part_by<L, streams>(from, to, count, halving.axis, key, less);
  if (less == first_half) return;

  // Some of those that equal the pivot are needed in front. They are set apart from larger ones, and all come back
  // before they are cut.
  const float next = next_key<L>(key);
  const std::size_t equal = count_less<L>(to[halving.axis] + less, count - less, next);
  float* equals[streams];
  float* larger[streams];
  for (unsigned s = 0; s < streams; ++s) {
    equals[s] = to[s] + less;
    larger[s] = from[s] + less;
  }
  part_by<L, streams>(equals, larger, count - less, halving.axis, next, equal);
  for (unsigned s = 0; s < streams; ++s) {
    __builtin_memcpy(from[s] + less, to[s] + less, (first_half - less) * sizeof(float));
    __builtin_memcpy(to[s] + less + equal, from[s] + less + equal, (count - less - equal) * sizeof(float));
  }
}

}  // namespace shaftcull::kernel
