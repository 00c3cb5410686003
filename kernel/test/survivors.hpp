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
    for (std::size_t w = 0; w < words; ++w) {
      for (std::uint64_t left = kept[w]; left != 0; left &= left - 1) {
        const auto i = static_cast<std::uint16_t>(w * word_bits + static_cast<unsigned>(__builtin_ctzll(left)));
        for (unsigned s = 0; s < streams; ++s) bound_[s][count_] = stream[s][i];
        position_[count_++] = i;
      }
    }
    // Fill the last vector, so that nothing is read that was not written.
    for (unsigned i = count_; i % L::width != 0; ++i) {
      for (unsigned s = 0; s < streams; ++s) bound_[s][i] = 0;
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

  /// Writes the survivors' bits back to where they came from; the other bits of `words` words become zero.
  void write_back(std::size_t words, std::uint64_t* bits) const noexcept {
    for (std::size_t w = 0; w < words; ++w) bits[w] = 0;
    for (unsigned i = 0; i < count_; ++i) {
      const std::uint64_t bit = bits_[i / word_bits] >> (i % word_bits) & 1;
      bits[position_[i] / word_bits] |= bit << (position_[i] % word_bits);
    }
  }

 private:
  float bound_[streams][most];
  std::uint16_t position_[most];
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
  survivors.write_back(words, bits);
}

}  // namespace shaftcull::kernel
