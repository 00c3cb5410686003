/// Survivors: later stages of a test run on the few bounds that earlier ones left, collected into full vectors.
///
/// On the usual scene one bound in fifty survives the first stage, so nearly every vector that holds a survivor holds only one.
/// Collecting costs a few cycles a survivor, and a stage then runs on a tenth of the vectors.
#pragma once

#include "test/word.hpp"

namespace shaftcull::kernel {

/// Blocks with a larger share of survivors are cheaper to work through as they are.
inline constexpr unsigned dense_share = 4;  // one in four

/// The survivors of one block, side by side, with the positions they came from.
template <class L, unsigned streams>
class Survivors {
 public:
  static constexpr unsigned most = block_words * word_bits / dense_share;
  static constexpr unsigned most_words = most / word_bits;

  /// Collects the bounds of `words` words whose bits in `kept` are set, at most `most`.
  Survivors(const float* const* stream, std::size_t words, const std::uint64_t* kept) noexcept {
    // A branch a bit would be mispredicted once a word. Four positions a word are written whatever it holds, and more than four are rare.
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t left = kept[w];
      const auto next_position = [&] {
        constexpr std::uint64_t never_zero = std::uint64_t{1} << 63;
        const auto i = static_cast<unsigned>(__builtin_ctzll(left | never_zero));
        left &= left - 1;
        return static_cast<std::uint16_t>(w * word_bits + i);
      };
      for (unsigned i = 0; i < at_once; ++i) position_[count_ + i] = next_position();
      const auto here = static_cast<unsigned>(__builtin_popcountll(kept[w]));
      for (unsigned i = at_once; i < here; ++i) position_[count_ + i] = next_position();
      count_ += here;
    }
    // The last vector is filled with the block's first bound, so that nothing is read that was not written.
    for (unsigned i = 0; i < L::width; ++i) position_[count_ + i] = 0;
    for (unsigned i = 0; i < count_; i += L::width) {
      for (unsigned s = 0; s < streams; ++s) L::store(&bound_[s][i], L::gather(stream[s], &position_[i]));
    }
    for (unsigned s = 0; s < streams; ++s) stream_[s] = bound_[s];
    for (unsigned w = 0; w < this->words(); ++w) {
      const unsigned here = count_ - w * word_bits;
      bits_[w] = here >= word_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << here) - 1;
    }
  }
  Survivors(const Survivors&) = delete;
  Survivors& operator=(const Survivors&) = delete;

  [[nodiscard]] const float* const* stream() const noexcept { return stream_; }
  [[nodiscard]] std::size_t words() const noexcept { return (count_ + word_bits - 1) / word_bits; }

  /// One bit a survivor, all set at first.
  [[nodiscard]] std::uint64_t* bits() noexcept { return bits_; }

  /// Writes the survivors' bits back to where they came from.
  void write_back(std::uint64_t* bits) const noexcept {
    for (unsigned w = 0; w < words(); ++w) {
      const unsigned here = count_ - w * word_bits;
      const std::uint64_t all = here >= word_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << here) - 1;
      for (std::uint64_t cleared = all & ~bits_[w]; cleared != 0; cleared &= cleared - 1) {
        const unsigned i = position_[w * word_bits + static_cast<unsigned>(__builtin_ctzll(cleared))];
        bits[i / word_bits] &= ~(std::uint64_t{1} << (i % word_bits));
      }
    }
  }
 private:
  static constexpr unsigned at_once = 3;

  float bound_[streams][most];
  std::uint16_t position_[most + 16];
  std::uint64_t bits_[most_words];
  const float* stream_[streams];
  unsigned count_ = 0;
};

/// Runs stage(stream, words, bits), which clears bits, on those bounds of a block whose bits are set.
template <class L, unsigned streams, class Stage>
void narrow(const float* const* stream, std::size_t words, std::uint64_t* bits, Stage stage) noexcept {
  unsigned count = 0;
  for (std::size_t w = 0; w < words; ++w) count += static_cast<unsigned>(__builtin_popcountll(bits[w]));
  if (count == 0) return;
  if (count * dense_share > words * word_bits) return stage(stream, words, bits);
  Survivors<L, streams> survivors(stream, words, bits);
  stage(survivors.stream(), survivors.words(), survivors.bits());
  survivors.write_back(bits);
}

}  // namespace shaftcull::kernel
