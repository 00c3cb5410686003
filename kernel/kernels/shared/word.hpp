// SPDX-License-Identifier: MIT
/// Words: 64 bounds at a time, and what every stage of a test shares.
///
/// A test is a row of stages over a block of words. Each stage sees the kept bits of the one before and only clears
/// some. A stage that cannot decide a lane for certain asks an exact predicate for that lane, so between stages every
/// bit is the real-arithmetic answer.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

inline constexpr unsigned word_bits = 64;

/// Words in a block: stages after the first find 2,048 bounds still in the cache.
inline constexpr std::size_t block_words = 32;
inline constexpr std::size_t block_bounds = block_words * word_bits;

/// Words in the largest block that stages are handed: a tile on the grid.
inline constexpr std::size_t most_block_words = 40;

/// Bits 0 … count − 1, fewer than 64. Always inlined, as words_of(): one copy for all instruction sets would be that of
/// any.
SHAFTCULL_ALWAYS_INLINE constexpr std::uint64_t first_bits(unsigned count) noexcept {
  return (std::uint64_t{1} << count) - 1;
}

/// How many words the bits of `count` bounds take.
SHAFTCULL_ALWAYS_INLINE constexpr std::size_t words_of(std::size_t count) noexcept {
  return (count + word_bits - 1) / word_bits;
}

/// The lanes of one vector within a word.
template <class L>
constexpr std::uint64_t lanes_of(unsigned offset) noexcept {
  return (L::width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << L::width) - 1) << offset;
}

/// Positions of consecutive words. operator()(w) is the position of the first bound of word w.
template <class L>
struct ConsecutiveWords {
  std::size_t first = 0;
  unsigned rest = 0;  ///< bounds of one more word, which they do not fill

  std::size_t operator()(std::size_t w) const noexcept { return first + w * word_bits; }
};

/// The last bounds of `count`, if they do not fill a word.
template <class L>
ConsecutiveWords<L> consecutive_words(std::size_t count) noexcept {
  return {.rest = static_cast<unsigned>(count % word_bits)};
}

/// How the vectors of a word of 64 bounds are read.
template <class L>
struct WholeWord {
  static constexpr unsigned bounds = word_bits;

  /// The bits of the bounds that there are.
  [[nodiscard]] static constexpr std::uint64_t lanes() noexcept { return ~std::uint64_t{0}; }
  /// The vector from a lane on of the word at `at`.
  [[nodiscard]] typename L::Vector load(const float* stream, std::size_t at, std::size_t lane) const noexcept {
    return L::load(stream + at + lane);
  }
  /// Of the vector from a lane on: `a` for the bounds that there are, and `b` in lanes behind them.
  [[nodiscard]] typename L::Vector choose(std::size_t /*lane*/, typename L::Vector a,
                                          typename L::Vector /*b*/) const noexcept {
    return a;
  }
};

/// Likewise of a word of `bounds`, fewer than 64, where they lie: nothing behind them is read, and lanes behind them
/// are 0.
template <class L>
struct PartialWord {
  unsigned bounds;

  [[nodiscard]] std::uint64_t lanes() const noexcept { return first_bits(bounds); }
  [[nodiscard]] typename L::Vector load(const float* stream, std::size_t at, std::size_t lane) const noexcept {
    // A vector without a bound takes the address of the word: a masked load of no lane is slow at an unmapped address.
    return part(lane).load(stream + at + (lane < bounds ? lane : 0));
  }
  [[nodiscard]] typename L::Vector choose(std::size_t lane, typename L::Vector a, typename L::Vector b) const noexcept {
    return part(lane).choose(a, b);
  }

 private:
  [[nodiscard]] typename L::FirstLanes part(std::size_t lane) const noexcept {
    return typename L::FirstLanes(static_cast<int>(bounds) - static_cast<int>(lane));
  }
};

/// A copy of the last bounds of a view, fewer than 64, that fills a word: for stages that read whole words.
template <class L, unsigned streams>
class PaddedWord {
 public:
  /// Of the `bounds` from `first` on, with `padding` a stream behind them.
  PaddedWord(const float* const* stream, std::size_t first, unsigned bounds, const float (&padding)[streams]) noexcept {
    const PartialWord<L> word{bounds};
    for (unsigned s = 0; s < streams; ++s) {
      const auto behind = L::all(padding[s]);
      unsigned lane = 0;
      for (; lane < bounds; lane += L::width) {
        L::store(&bound_[s][lane], word.choose(lane, word.load(stream[s], first, lane), behind));
      }
      for (; lane < word_bits; lane += L::width) L::store(&bound_[s][lane], behind);
      stream_[s] = bound_[s];
    }
  }
  PaddedWord(const PaddedWord&) = delete;
  PaddedWord& operator=(const PaddedWord&) = delete;

  [[nodiscard]] const float* const* stream() const noexcept { return stream_; }

 private:
  alignas(64) float bound_[streams][word_bits];
  const float* stream_[streams];
};

/// Runs stage(stream, words, bits), which reads whole words, on `count` bounds. Bits behind the last bound are those of
/// the padding.
template <class L, unsigned streams, class Stage>
void in_whole_words(const float* const* stream, std::size_t count, std::uint64_t* bits, const float (&padding)[streams],
                    Stage stage) noexcept {
  const std::size_t words = count / word_bits;
  if (words != 0) stage(stream, words, bits);
  const auto rest = static_cast<unsigned>(count % word_bits);
  if (rest == 0) return;
  const PaddedWord<L, streams> last(stream, count - rest, rest, padding);
  stage(last.stream(), 1, bits + words);
}

/// Writes the bits that a stage starts from: those of an earlier stage, or ones for all `count` bounds.
template <class L>
void copy_or_set(const std::uint64_t* from, std::size_t count, std::uint64_t* bits) noexcept {
  for (std::size_t w = 0; w < words_of(count); ++w) bits[w] = from != nullptr ? from[w] : ~std::uint64_t{0};
  if (count % word_bits != 0) bits[count / word_bits] &= first_bits(count % word_bits);
}

/// Runs a first stage, stage(stream, words, bits), which reads whole words and writes bits, on `count` bounds.
template <class L, unsigned streams, class Stage>
void begin_in_whole_words(const float* const* stream, std::size_t count, std::uint64_t* bits,
                          const float (&padding)[streams], Stage stage) noexcept {
  in_whole_words<L>(stream, count, bits, padding, stage);
  if (count % word_bits != 0) bits[count / word_bits] &= first_bits(count % word_bits);
}

/// Calls decide(lane), an exact predicate, for every bit of `lanes`, and returns the bits for which it was true. A
/// vector type may have a note_undecided(), which is told of the lanes: tests count by it.
template <class L, class Decide>
SHAFTCULL_COLD std::uint64_t decide_lanes(std::uint64_t lanes, Decide decide) noexcept {
  if constexpr (requires { L::note_undecided(lanes); }) L::note_undecided(lanes);
  std::uint64_t yes = 0;
  for (; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<unsigned>(trailing_zeros(lanes));
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
