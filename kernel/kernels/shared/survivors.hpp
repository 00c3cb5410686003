// SPDX-License-Identifier: MIT
/// Survivors: later stages of a test run on the few bounds that earlier ones left, collected into full vectors.
///
/// On the usual scene one bound in fifty survives the first stage, so nearly every vector that holds a survivor holds
/// only one. Collecting costs a few cycles a survivor, and a stage then runs on a tenth of the vectors.
#pragma once

#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// In blocks with a larger share of survivors it is cheaper to run the stage on all bounds.
inline constexpr unsigned dense_share = 4;  // one in four

/// The most bounds that are collected of the largest block.
inline constexpr unsigned most_survivors = most_block_words * word_bits / dense_share;

/// Positions of the set bits of one block.
template <class L, unsigned most = most_survivors>
class Positions {
 public:
  /// Of the bits of `words` words, of which at most `most` are set.
  Positions(const std::uint64_t* bits, std::size_t words) noexcept {
    // A branch a bit would be mispredicted once a word. Some positions a word are written whatever it holds, and more
    // than that are rare.
    std::uint16_t* end = position_;
    for (std::size_t w = 0; w < words; ++w) {
      const auto first = static_cast<unsigned>(w * word_bits);
      std::uint64_t left = bits[w];
      std::uint16_t* out = end;
      end += popcount(left);
      do {
        SHAFTCULL_UNROLL(3)
        for (unsigned i = 0; i < at_once; ++i, left &= left - 1)
          out[i] = static_cast<std::uint16_t>(first + L::lowest_bit(left));
        out += at_once;
      } while (out < end);
    }
    count_ = static_cast<unsigned>(end - position_);
  }

  [[nodiscard]] unsigned count() const noexcept { return count_; }
  [[nodiscard]] unsigned operator[](unsigned i) const noexcept { return position_[i]; }
  [[nodiscard]] const std::uint16_t* from(unsigned i) const noexcept { return position_ + i; }

  /// Makes the last vector of positions full.
  void fill_up(std::uint16_t with) noexcept {
    for (unsigned i = 0; i < L::width; ++i) position_[count_ + i] = with;
  }

 private:
  static constexpr unsigned at_once = 3;

  std::uint16_t position_[most + 16];
  unsigned count_;
};

/// The survivors of one block, side by side: at most `most`.
template <class L, unsigned streams, unsigned most = most_survivors>
class Survivors {
 public:
  static constexpr unsigned most_words = most / word_bits;

  /// Collects the bounds of `words` words whose bits in `kept` are set, at most `most`.
  Survivors(const float* const* stream, std::size_t words, const std::uint64_t* kept) noexcept
      : position_(kept, words) {
    // The last vector is filled with the block's first bound, so that nothing is read that was not written.
    position_.fill_up(0);
    for (unsigned i = 0; i < position_.count(); i += L::width) {
      for (unsigned s = 0; s < streams; ++s) L::store(&bound_[s][i], L::gather(stream[s], position_.from(i)));
    }
    for (unsigned s = 0; s < streams; ++s) stream_[s] = bound_[s];
    for (unsigned w = 0; w < this->words(); ++w) bits_[w] = all(w);
  }
  Survivors(const Survivors&) = delete;
  Survivors& operator=(const Survivors&) = delete;

  [[nodiscard]] const float* const* stream() const noexcept { return stream_; }
  [[nodiscard]] std::size_t words() const noexcept { return (position_.count() + word_bits - 1) / word_bits; }

  /// One bit a survivor, all set at first.
  [[nodiscard]] std::uint64_t* bits() noexcept { return bits_; }

  /// Writes the survivors' bits back to where they came from.
  void write_back(std::uint64_t* bits) const noexcept {
    for (unsigned w = 0; w < words(); ++w) {
      for (std::uint64_t cleared = all(w) & ~bits_[w]; cleared != 0; cleared &= cleared - 1) {
        const unsigned i = position_[w * word_bits + static_cast<unsigned>(trailing_zeros(cleared))];
        bits[i / word_bits] &= ~(std::uint64_t{1} << (i % word_bits));
      }
    }
  }

 private:
  /// A word of survivors' bits, all set.
  [[nodiscard]] std::uint64_t all(unsigned w) const noexcept {
    const unsigned here = position_.count() - w * word_bits;
    return here >= word_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << here) - 1;
  }

  Positions<L, most> position_;
  float bound_[streams][most];
  std::uint64_t bits_[most_words];
  const float* stream_[streams];
};

/// Whether there are few enough set bits for their bounds to be collected.
template <class L>
[[nodiscard]] bool are_sparse(const std::uint64_t* bits, std::size_t words) noexcept {
  unsigned count = 0;
  SHAFTCULL_UNROLL(8)
  for (std::size_t w = 0; w < words; ++w) count += static_cast<unsigned>(popcount(bits[w]));
  return count * dense_share <= words * word_bits;
}

/// Runs stage(stream, words, bits), which clears bits, on those of a block's `count` bounds whose bits are set. Bits
/// behind the last bound are not.
template <class L, unsigned streams, unsigned most = most_survivors, class Stage>
void run_on_survivors(const float* const* stream, std::size_t count, std::uint64_t* bits, Stage stage) noexcept {
  if (!are_sparse<L>(bits, words_of(count))) {
    constexpr float any[streams] = {};
    return in_whole_words<L>(stream, count, bits, any, stage);
  }
  Survivors<L, streams, most> survivors(stream, words_of(count), bits);
  if (survivors.words() == 0) return;
  stage(survivors.stream(), survivors.words(), survivors.bits());
  survivors.write_back(bits);
}

}  // namespace shaftcull::kernel
