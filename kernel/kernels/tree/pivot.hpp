// SPDX-License-Identifier: MIT
/// Where to halve entries of a bounds tree: the key of an exact rank is found by counting.
///
/// Counting has no branch that depends on a key, and is quick on vectors. Of many entries, a sample brackets the key of
/// the rank, and one pass collects the few keys in the bracket (Floyd and Rivest, "Expected time bounds for selection",
/// 1975).
#pragma once

#include <cmath>

#include "kernels/kernel_table.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Finite floats numbered in their order without gaps; −0 is 0.
template <class L>
struct FloatNumber {
  static std::int32_t of(float x) noexcept {
    const auto bits = __builtin_bit_cast(std::int32_t, x);
    return bits < 0 ? -(bits & 0x7fffffff) : bits;
  }
  static float at(std::int32_t number) noexcept {
    return number < 0 ? -__builtin_bit_cast(float, -number) : __builtin_bit_cast(float, number);
  }
};

/// The smallest float that is larger than a key, which is finite.
template <class L>
float next_key(float key) noexcept {
  return FloatNumber<L>::at(FloatNumber<L>::of(key) + 1);
}

/// The smallest and the largest of some keys.
struct KeyRange {
  float lo;
  float hi;
};

/// Ranges of some streams, each of at least one key. They are found together, because a minimum waits for the one
/// before.
template <class L, unsigned streams>
struct KeyRanges {
  KeyRange stream[streams];

  KeyRanges(const float* const* key, std::size_t count) noexcept {
    for (unsigned s = 0; s < streams; ++s) stream[s] = {key[s][0], key[s][0]};
    std::size_t i = 0;
    if (L::width > 1 && count >= L::width) {
      typename L::Vector least[streams];
      typename L::Vector most[streams];
      for (unsigned s = 0; s < streams; ++s) least[s] = most[s] = L::load(key[s]);
      for (i = L::width; i + L::width <= count; i += L::width) {
        for (unsigned s = 0; s < streams; ++s) {
          const auto x = L::load(key[s] + i);
          least[s] = L::minimum(x, least[s]);
          most[s] = L::maximum(x, most[s]);
        }
      }
      for (unsigned s = 0; s < streams; ++s) stream[s] = {L::smallest(least[s]), L::largest(most[s])};
    }
    for (; i < count; ++i) {
      for (unsigned s = 0; s < streams; ++s) {
        const float x = key[s][i];
        stream[s] = {x < stream[s].lo ? x : stream[s].lo, x > stream[s].hi ? x : stream[s].hi};
      }
    }
  }
};

template <class L>
KeyRange range_of(const float* key, std::size_t count) noexcept {
  return KeyRanges<L, 1>(&key, count).stream[0];
}

/// The axis on which centres are spread out most.
template <class L>
unsigned widest_axis(const KeyRange (&range)[3]) noexcept {
  unsigned widest = 0;
  for (unsigned k = 1; k < 3; ++k) {
    if (range[k].hi - range[k].lo > range[widest].hi - range[widest].lo) widest = k;
  }
  return widest;
}

/// How many keys are less than a limit.
template <class L>
std::size_t count_less(const float* key, std::size_t count, float limit) noexcept {
  [[maybe_unused]] const auto limits = L::all(limit);
  std::size_t less = 0;
  std::size_t i = 0;
  if constexpr (L::width > 1) {
    for (; i + L::width <= count; i += L::width) {
      less += static_cast<std::size_t>(popcount(L::bits(L::less(L::load(key + i), limits))));
    }
  }
  for (; i < count; ++i) less += key[i] < limit ? 1 : 0;
  return less;
}

/// The smallest key that is not less than a limit; there is one.
template <class L>
float smallest_from(const float* key, std::size_t count, float limit) noexcept {
  const auto none = L::all(INFINITY);
  auto smallest = none;
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    const auto x = L::load(key + i);
    smallest = L::minimum(L::choose(L::less(x, L::all(limit)), none, x), smallest);
  }
  float least = L::smallest(smallest);
  for (; i < count; ++i) least = key[i] >= limit && key[i] < least ? key[i] : least;
  return least;
}
/// The largest key that is less than a limit; there is one.
template <class L>
float largest_below(const float* key, std::size_t count, float limit) noexcept {
  const auto none = L::all(-INFINITY);
  auto largest = none;
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    const auto x = L::load(key + i);
    largest = L::maximum(L::choose(L::less(x, L::all(limit)), x, none), largest);
  }
  float most = L::largest(largest);
  for (; i < count; ++i) most = key[i] < limit && key[i] > most ? key[i] : most;
  return most;
}

/// A key, and how many are less.
struct Pivot {
  float key;
  std::size_t less;
};

/// A value that exactly `rank` of `count` keys are less than. If there is none, since equal keys straddle that rank,
/// their value. All keys are within `range`; rank < count.
template <class L>
Pivot pivot_at(const float* key, std::size_t count, std::size_t rank, const KeyRange& range) noexcept {
  using Number = FloatNumber<L>;
  std::int32_t lo = Number::of(range.lo);  // `below_lo` keys are less than that: no more than the rank
  std::int32_t hi = Number::of(range.hi);  // `below_hi` are less than what follows that: more than the rank
  std::size_t below_lo = 0;
  std::size_t below_hi = count;
  for (unsigned step = 1; lo != hi; ++step) {
    auto middle = static_cast<std::int32_t>((std::int64_t{lo} + hi + 1) / 2);
    if (step % 4 != 0) {  // most steps interpolate, and one in four halves the range, however keys are distributed
      const double share = (static_cast<double>(rank - below_lo) + 0.5) / static_cast<double>(below_hi - below_lo);
      const double from = Number::at(lo);
      middle = Number::of(static_cast<float>(from + (static_cast<double>(Number::at(hi)) - from) * share));
    }
    middle = middle <= lo ? lo + 1 : middle > hi ? hi : middle;
    const std::size_t below = count_less<L>(key, count, Number::at(middle));
    if (below == rank) return {Number::at(middle), below};
    // Where no key was between, the range ends at the next one: few values that many share are soon told apart.
    if (below < rank) {
      lo = below == below_lo ? Number::of(smallest_from<L>(key, count, Number::at(middle))) : middle;
      below_lo = below;
    } else {
      hi = below == below_hi ? Number::of(largest_below<L>(key, count, Number::at(middle))) : middle - 1;
      below_hi = below;
    }
  }
  return {Number::at(lo), below_lo};
}

/// As SplitKernels::bracket.
template <class L>
SampleBracket bracket_of(const float* const* entry, std::size_t count, std::size_t rank,
                         float* const* scratch) noexcept {
  const std::size_t step = count <= 4096 ? 16 : 64;  // a sample of fewer would be too rough
  const std::size_t samples = count / step;
  for (unsigned k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < samples; ++i) scratch[k][i] = entry[k][i * step];
  }
  const KeyRanges<L, 3> range(scratch, samples);
  const unsigned axis = widest_axis<L>(range.stream);

  // The sample's ranks scatter with a standard deviation of √(s p (1 − p)): beyond three of them is once in hundreds of
  // cuts.
  const double share = static_cast<double>(rank) / static_cast<double>(count);
  const double middle = share * static_cast<double>(samples);
  const double off = 3 * sqrt(middle * (1 - share));
  const auto lo = static_cast<std::size_t>(middle > off ? middle - off : 0);
  const auto hi = static_cast<std::size_t>(middle + off + 1);
  return {axis, pivot_at<L>(scratch[axis], samples, lo, range.stream[axis]).key,
          pivot_at<L>(scratch[axis], samples, hi < samples ? hi : samples - 1, range.stream[axis]).key};
}

/// As SplitKernels::collect_in_bracket.
template <class L>
BracketCounts collect_in_bracket(const float* key, std::size_t count, const SampleBracket& bracket,
                                 float* some) noexcept {
  const auto froms = L::all(bracket.from);
  const auto tos = L::all(bracket.to);
  std::size_t below = 0;
  std::size_t between = 0;
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    const auto keys = L::load(key + i);
    const std::uint64_t is_below = L::bits(L::less(keys, froms));
    const std::uint64_t is_between = L::bits(L::less_equal(keys, tos)) & ~is_below;
    below += static_cast<std::size_t>(popcount(is_below));
    typename L::Compressor(is_between).store(some + between, keys);
    between += static_cast<std::size_t>(popcount(is_between));
  }
  for (; i < count; ++i) {
    if (key[i] < bracket.from) {
      ++below;
    } else if (key[i] <= bracket.to) {
      some[between++] = key[i];
    }
  }
  return {below, between};
}

/// The axis to halve entries on, and where.
struct Halving {
  unsigned axis;
  Pivot pivot;
};

/// Looks at all entries.
template <class L>
Halving halving_of_few(const float* const* entry, std::size_t count, std::size_t rank) noexcept {
  const KeyRanges<L, 3> range(entry, count);
  const unsigned axis = widest_axis<L>(range.stream);
  return {axis, pivot_at<L>(entry[axis], count, rank, range.stream[axis])};
}

/// Looks at a sample, and then once at all keys of one axis. `scratch` is three streams of `count` floats.
template <class L>
Halving halving_of_many(const float* const* entry, std::size_t count, std::size_t rank,
                        float* const* scratch) noexcept {
  const SampleBracket bracket = bracket_of<L>(entry, count, rank, scratch);
  const float* const key = entry[bracket.axis];
  float* const some = scratch[bracket.axis];
  const BracketCounts found = collect_in_bracket<L>(key, count, bracket, some);
  if (rank < found.below || rank >= found.below + found.between) {  // the sample was not like the rest
    return {bracket.axis, pivot_at<L>(key, count, rank, range_of<L>(key, count))};
  }
  const Pivot pivot = pivot_at<L>(some, found.between, rank - found.below, range_of<L>(some, found.between));
  return {bracket.axis, {pivot.key, found.below + pivot.less}};
}

}  // namespace shaftcull::kernel
