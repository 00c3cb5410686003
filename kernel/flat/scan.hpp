// SPDX-License-Identifier: MIT
/// One shaft against bounds in streams, chunk by chunk, whose bits stay on the stack.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "compiled/with_planes.hpp"
#include "flat/left_out.hpp"
#include "flat/scanned_bounds.hpp"
#include "kernels/kernel_table.hpp"
#include "query/bound_test.hpp"
#include "query/counters.hpp"
#include "query/options.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/results.hpp"
#include "support/compiler.hpp"
#include "support/float_environment.hpp"

namespace shaftcull::kernel {

/// Most bounds in a chunk: enough that the fixed cost of a kernel call vanishes, and few enough for bits on the stack.
inline constexpr std::size_t chunk_bounds = 16384;
/// The first chunk of a call that may end early; each has twice as many as the one before.
inline constexpr std::size_t first_chunk_bounds = 512;

/// Bits of bounds, or candidates, from `first` on, a multiple of 64. `inside` is null unless the question asks for it.
struct ScannedChunk {
  std::size_t first;
  std::size_t words;
  std::uint64_t* kept;
  const std::uint64_t* inside;
};

/// Calls use(i) for every set bit, ascending, until it returns false.
template <class Use>
void for_each_bit(const std::uint64_t* bits, std::size_t words, const Use& use) {
  for (std::size_t w = 0; w != words; ++w) {
    for (std::uint64_t left = bits[w]; left != 0; left &= left - 1) {
      if (!use(64 * w + static_cast<std::size_t>(std::countr_zero(left)))) return;
    }
  }
}

/// Calls use(stream, first, size) for slices of bounds until it returns false. The first slice has `chunk` bounds at
/// most; each has up to twice as many as the one before.
template <class Use>
SHAFTCULL_ALWAYS_INLINE inline void for_each_slice(const BoundStreams& bounds, std::size_t chunk, const Use& use) {
  // The first slice has the pointers of the view: reading copies that have just been written would cost a small view
  // as much as its test.
  const float* const* stream = bounds.stream;
  const float* part[9];
  for (std::size_t first = 0; first != bounds.count;) {
    const std::size_t size = std::min(chunk, bounds.count - first);
    if (!use(stream, first, size)) return;
    first += size;
    chunk = std::min(2 * chunk, chunk_bounds);
    for (std::size_t r = 0; r != bounds.rows; ++r) part[r] = bounds.stream[r] + first;
    stream = part;
  }
}

/// Bounds of the first chunk that a counter is given.
template <class AnyCounter>
[[nodiscard]] constexpr std::size_t first_chunk_for(const AnyCounter& /*counter*/) noexcept {
  return EndsEarly<AnyCounter> ? first_chunk_bounds : chunk_bounds;
}

/// A checked question of one shaft. Refers to the bounds and the options.
class Scan {
 public:
  /// `s` is the position of the shaft among those that `options` are of.
  Scan(const ShaftData& shaft, const ScannedBounds& bounds, Question question, const Options& options, std::size_t s,
       const Kernels& kernels) noexcept;
  Scan(const Scan&) = delete;
  Scan& operator=(const Scan&) = delete;

  /// Calls visit(chunk) until it returns false. The first chunk has `chunk` bounds at most.
  template <class Visit>
  void for_each_chunk(std::size_t chunk, const Visit& visit) const {
    const FloatEnvironment environment;
    if (bounds_.candidates) {
      for_each_chunk_of_candidates(visit);
    } else {
      for_each_chunk_of_view(chunk, visit);
    }
  }
  /// The user's index of bound, or candidate, i of the scan.
  [[nodiscard]] std::uint32_t index_of(std::size_t i) const noexcept {
    return bounds_.candidates ? (*bounds_.candidates)[i] : static_cast<std::uint32_t>(i);
  }

  /// Gives a counter (query/counters.hpp) the bounds that the shaft keeps and that are not left out.
  template <class AnyCounter>
  void scan(AnyCounter& counter) const {
    for_each_chunk(first_chunk_for(counter), [&](const ScannedChunk& chunk) {
      counter.words({nullptr, chunk.kept, chunk.inside, chunk.words});
      return !is_done(counter);
    });
  }

 private:
  // Not inlined, so that the memory of one is not on the stack of the other.
  template <class Visit>
  void for_each_chunk_of_view(std::size_t chunk, const Visit& visit) const;
  void for_each_chunk_of_candidates(FunctionRef<bool(const ScannedChunk&)> visit) const;

  BoundTest test_;
  WithPlanes shaft_;  // completed once, not chunk by chunk
  const ScannedBounds& bounds_;
  LeftOut left_out_;
  Question question_;
};

template <class Visit>
SHAFTCULL_NOINLINE void Scan::for_each_chunk_of_view(std::size_t chunk, const Visit& visit) const {
  std::uint64_t kept[bit_words(chunk_bounds)];
  std::uint64_t inside_memory[bit_words(chunk_bounds)];
  std::uint64_t* const inside = asks_for_inside(question_) ? inside_memory : nullptr;
  for_each_slice(bounds_.streams, chunk, [&](const float* const* stream, std::size_t first, std::size_t size) {
    test_(shaft_.shaft(), stream, size, kept, inside);
    left_out_.clear(first, size, kept);
    left_out_.clear(first, size, inside);
    return visit(ScannedChunk{first, bit_words(size), kept, inside});
  });
}

/// Writes the bits of all bounds in streams. `kept` is null for Question::inside, `inside` for Question::kept.
void write_bits_of_view(const ShaftData& shaft, const ScannedBounds& bounds, Question question, const Options& options,
                        const Kernels& kernels, std::uint64_t* kept, std::uint64_t* inside) noexcept;

}  // namespace shaftcull::kernel
