// SPDX-License-Identifier: MIT
/// Halving entries of a bounds tree: one pass without a branch that depends on a key.
#pragma once

#include <cstring>

#include "kernels/tree/pivot.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// How many floats ahead of those read or written are prefetched. Processors prefetch reads by themselves, but not
/// these writes: without it parts that the L2 cache holds take half as long again.
inline constexpr std::size_t prefetched_floats = 48;

/// Keeps the `low` entries whose key is below the limit in `from`, and moves the others to `to`, from place `low` on.
template <class L>
void partition_by(float* const* from, float* const* to, std::size_t count, unsigned axis, float limit,
                  std::size_t low) noexcept {
  const auto limits = L::all(limit);
  std::size_t kept = 0;
  std::size_t moved = low;
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    const std::uint64_t is_low = L::bits(L::less(L::load(from[axis] + i), limits));
    const typename L::Compressor low_ones(is_low);
    const typename L::Compressor high_ones(~is_low & lanes_of<L>(0));
    const auto lows = static_cast<std::size_t>(popcount(is_low));
    const bool has_room = moved + L::width <= count;
    for (std::size_t s = 0; s != entry_streams; ++s) {
      prefetch_to_write(to[s] + moved + prefetched_floats);
      prefetch_to_write(from[s] + kept + prefetched_floats);
      prefetch_to_read(from[s] + i + prefetched_floats);
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
    for (std::size_t s = 0; s != entry_streams; ++s) {
      const float x = from[s][i];
      *(is_low ? from[s] + kept : to[s] + moved) = x;
    }
    ++(is_low ? kept : moved);
  }
}

/// As SplitKernels::halve.
template <class L>
void split_entries(float* const* from, float* const* to, std::size_t count, std::size_t first_half) noexcept {
  constexpr std::size_t few = 1024;  // the same for all, since the axis depends on it
  const Halving halving =
      count <= few ? halving_of_few<L>(from, count, first_half) : halving_of_many<L>(from, count, first_half, to);
  const auto [key, less] = halving.pivot;
  partition_by<L>(from, to, count, halving.axis, key, less);
  if (less == first_half) return;

  // Entries that equal the pivot are on both sides of the cut. They are separated from larger ones, and then both are
  // copied to their sides.
  const float next = next_key<L>(key);
  const std::size_t equal = count_less<L>(to[halving.axis] + less, count - less, next);
  float* equals[entry_streams];
  float* larger[entry_streams];
  for (std::size_t s = 0; s != entry_streams; ++s) {
    equals[s] = to[s] + less;
    larger[s] = from[s] + less;
  }
  partition_by<L>(equals, larger, count - less, halving.axis, next, equal);
  for (std::size_t s = 0; s != entry_streams; ++s) {
    std::memcpy(from[s] + less, to[s] + less, (first_half - less) * sizeof(float));
    std::memcpy(to[s] + less + equal, from[s] + less + equal, (count - less - equal) * sizeof(float));
  }
}

/// Appends entries to streams that have space for a given number of them.
template <class L>
class EntryWriter {
 public:
  EntryWriter(float* const* to, std::size_t size) noexcept : left_(size) {
    for (std::size_t s = 0; s != entry_streams; ++s) to_[s] = to[s];
  }

  /// Writes those of some vectors' lanes, one vector of each stream, whose bits are set.
  void write(std::uint64_t lanes, const typename L::Vector (&x)[entry_streams]) noexcept {
    const typename L::Compressor ones(lanes);
    const auto count = static_cast<std::size_t>(popcount(lanes));
    const bool has_room = left_ >= L::width;
    for (std::size_t s = 0; s != entry_streams; ++s) {
      prefetch_to_write(to_[s] + prefetched_floats);
      if (has_room) {
        ones.store(to_[s], x[s]);
      } else {
        ones.store(to_[s], x[s], count);
      }
      to_[s] += count;
    }
    left_ -= count;
  }
  void write(const float* const* from, std::size_t i) noexcept {
    for (std::size_t s = 0; s != entry_streams; ++s) *to_[s]++ = from[s][i];
    --left_;
  }

 private:
  float* to_[entry_streams];
  std::size_t left_;
};

/// As SplitKernels::scatter.
template <class L>
void scatter(const float* const* from, std::size_t count, unsigned axis, float pivot, const KeyCounts& counts,
             float* const* less, float* const* equal, float* const* larger) noexcept {
  const bool are_apart = equal != nullptr;
  const float next = are_apart ? next_key<L>(pivot) : pivot;
  EntryWriter<L> lesses(less, counts.less);
  EntryWriter<L> equals(are_apart ? equal : larger, are_apart ? counts.equal : 0);
  EntryWriter<L> others(larger, count - counts.less - (are_apart ? counts.equal : 0));
  const auto pivots = L::all(pivot);
  const auto nexts = L::all(next);
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) {
    typename L::Vector x[entry_streams];
    for (std::size_t s = 0; s != entry_streams; ++s) x[s] = L::load(from[s] + i);
    const auto key = L::load(from[axis] + i);
    const std::uint64_t is_less = L::bits(L::less(key, pivots));
    const std::uint64_t is_before = L::bits(L::less(key, nexts));
    lesses.write(is_less, x);
    if (are_apart) equals.write(is_before & ~is_less, x);
    others.write(~is_before & lanes_of<L>(0), x);
  }
  for (; i < count; ++i) {
    const float key = from[axis][i];
    (key < pivot ? lesses : key < next ? equals : others).write(from, i);
  }
}

template <class L>
inline constexpr SplitKernels split_kernels = {
    .halve = split_entries<L>,
    .bracket = [](const float* const* entry, std::size_t count, std::size_t rank,
                  float* const* scratch) noexcept { return bracket_of<L>(entry, count, rank, scratch); },
    .collect_in_bracket = [](const float* key, std::size_t count, const SampleBracket& bracket,
                             float* some) noexcept { return collect_in_bracket<L>(key, count, bracket, some); },
    .pivot = [](const float* key, std::size_t count,
                std::size_t rank) noexcept { return pivot_at<L>(key, count, rank, range_of<L>(key, count)).key; },
    .count_keys =
        [](const float* key, std::size_t count, float pivot) noexcept {
          const std::size_t less = count_less<L>(key, count, pivot);
          return KeyCounts{less, count_less<L>(key, count, next_key<L>(pivot)) - less};
        },
    .scatter = scatter<L>,
};

}  // namespace shaftcull::kernel
