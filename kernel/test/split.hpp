/// Halving entries of a bounds tree: the key of an exact rank is found by counting, and one pass goes by it.
///
/// Counting and passing have no branch that depends on a key, and both are quick on vectors. Of many entries a sample
/// tells between which two keys the rank must be, and one pass collects the few that are (Floyd and Rivest, "Expected
/// time bounds for selection", 1975).
#pragma once

#include "simd/float_environment.hpp"
#include "test/kernels.hpp"
#include "test/unite.hpp"
#include "test/word.hpp"

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

/// The smallest and the largest of at least one key.
template <class L>
struct KeyRange {
  float lo;
  float hi;

  KeyRange(const float* key, std::size_t count) noexcept : lo(key[0]), hi(key[0]) {
    std::size_t i = 0;
    if (L::width > 1 && count >= L::width) {
      auto least = L::load(key);
      auto most = least;
      for (i = L::width; i + L::width <= count; i += L::width) {
        const auto x = L::load(key + i);
        least = L::minimum(x, least);
        most = L::maximum(x, most);
      }
      lo = smallest_lane<L>(least);
      hi = largest_lane<L>(most);
    }
    for (; i < count; ++i) {
      lo = key[i] < lo ? key[i] : lo;
      hi = key[i] > hi ? key[i] : hi;
    }
  }
};

/// The axis on which centres are spread out most.
template <class L>
unsigned widest_axis(const KeyRange<L> (&range)[3]) noexcept {
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
      less += static_cast<std::size_t>(__builtin_popcountll(L::bits(L::less(L::load(key + i), limits))));
    }
  }
  for (; i < count; ++i) less += key[i] < limit ? 1 : 0;
  return less;
}

/// The smallest key that is not less than a limit; there is one.
template <class L>
float smallest_from(const float* key, std::size_t count, float limit) noexcept {
  const auto none = L::all(__builtin_inff());
  auto smallest = none;
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    const auto x = L::load(key + i);
    smallest = L::minimum(L::choose(L::less(x, L::all(limit)), none, x), smallest);
  }
  float least = smallest_lane<L>(smallest);
  for (; i < count; ++i) least = key[i] >= limit && key[i] < least ? key[i] : least;
  return least;
}
/// The largest key that is less than a limit; there is one.
template <class L>
float largest_below(const float* key, std::size_t count, float limit) noexcept {
  const auto none = L::all(-__builtin_inff());
  auto largest = none;
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    const auto x = L::load(key + i);
    largest = L::maximum(L::choose(L::less(x, L::all(limit)), x, none), largest);
  }
  float most = largest_lane<L>(largest);
  for (; i < count; ++i) most = key[i] < limit && key[i] > most ? key[i] : most;
  return most;
}

/// A key, and how many are less.
struct Pivot {
  float key;
  std::size_t less;
};

/// Of `count` keys within `range`, one that `rank` are less than; if equal ones straddle that rank, those. rank <
/// count.
template <class L>
Pivot pivot_at(const float* key, std::size_t count, std::size_t rank, const KeyRange<L>& range) noexcept {
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

/// The axis to halve entries on, and where.
template <class L>
struct Halving {
  unsigned axis;
  Pivot pivot;

  /// Looks at all entries.
  static Halving among_few(const float* const* entry, std::size_t count, std::size_t rank) noexcept {
    const KeyRange<L> range[3] = {{entry[0], count}, {entry[1], count}, {entry[2], count}};
    const unsigned axis = widest_axis<L>(range);
    return {axis, pivot_at<L>(entry[axis], count, rank, range[axis])};
  }

  /// Looks at a sample, and then once at all keys of one axis. `room` is three streams of `count` floats.
  static Halving among_many(const float* const* entry, std::size_t count, std::size_t rank,
                            float* const* room) noexcept {
    constexpr std::size_t step = 64;
    const std::size_t samples = count / step;
    for (unsigned k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < samples; ++i) room[k][i] = entry[k][i * step];
    }
    const KeyRange<L> range[3] = {{room[0], samples}, {room[1], samples}, {room[2], samples}};
    const unsigned axis = widest_axis<L>(range);

    // The sample's ranks scatter with a standard deviation of √(s p (1 − p)): beyond three of them is once in hundreds
    // of cuts.
    const double share = static_cast<double>(rank) / static_cast<double>(count);
    const double middle = share * static_cast<double>(samples);
    const double off = 3 * __builtin_sqrt(middle * (1 - share));
    const auto lo = static_cast<std::size_t>(middle > off ? middle - off : 0);
    const auto hi = static_cast<std::size_t>(middle + off + 1);
    const float from = pivot_at<L>(room[axis], samples, lo, range[axis]).key;
    const float to = pivot_at<L>(room[axis], samples, hi < samples ? hi : samples - 1, range[axis]).key;

    float* const some = room[axis];
    const auto froms = L::all(from);
    const auto tos = L::all(to);
    std::size_t below = 0;
    std::size_t between = 0;
    std::size_t i = 0;
    for (; i + L::width <= count; i += L::width) {
      const auto key = L::load(entry[axis] + i);
      const std::uint64_t is_below = L::bits(L::less(key, froms));
      const std::uint64_t is_between = L::bits(L::less_equal(key, tos)) & ~is_below;
      below += static_cast<std::size_t>(__builtin_popcountll(is_below));
      typename L::Packing(is_between).store(some + between, key);
      between += static_cast<std::size_t>(__builtin_popcountll(is_between));
    }
    for (; i < count; ++i) {
      const float key = entry[axis][i];
      if (key < from) {
        ++below;
      } else if (key <= to) {
        some[between++] = key;
      }
    }
    if (rank < below || rank >= below + between) {  // the sample was not like the rest
      return {axis, pivot_at<L>(entry[axis], count, rank, KeyRange<L>(entry[axis], count))};
    }
    const Pivot pivot = pivot_at<L>(some, between, rank - below, KeyRange<L>(some, between));
    return {axis, {pivot.key, below + pivot.less}};
  }
};

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
  const auto halving = count <= few ? Halving<L>::among_few(from, count, first_half)
                                    : Halving<L>::among_many(from, count, first_half, to);
  const auto [key, less] = halving.pivot;
  part_by<L, streams>(from, to, count, halving.axis, key, less);
  if (less == first_half) return;

  // Some of those that equal the pivot are needed in front. They are set apart from larger ones, and all come back
  // before they are cut.
  const float next = FloatNumber<L>::at(FloatNumber<L>::of(key) + 1);
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
