/// Two copies of the same loops: for any x86-64 (or other) processor, and for one with POPCNT and BMI1.
///
/// With few set bits, a loop "while the word is not zero" is one mispredicted branch a word. So, as in simdjson
/// (Langdale and Lemire, "Parsing Gigabytes of JSON per Second", 2019), four positions are always written, and the
/// end moves on by the number of set bits; only a word with more than four of them takes a branch.
#include "run/set_bits.hpp"

#include <bit>

namespace shaftcull::kernel {
namespace {

[[gnu::always_inline]] inline std::size_t count_bits(const std::uint64_t* words, std::size_t count) noexcept {
  std::size_t bits = 0;
  for (std::size_t w = 0; w != count; ++w) bits += static_cast<std::size_t>(std::popcount(words[w]));
  return bits;
}

[[gnu::always_inline]] inline std::uint32_t* write_bits(const std::uint64_t* words, std::size_t count, std::uint32_t first,
                                                        std::uint32_t* out) noexcept {
  for (std::size_t w = 0; w != count; ++w, first += 64) {
    std::uint64_t word = words[w];
    std::uint32_t* const end = out + std::popcount(word);
    do {
      for (std::size_t i = 0; i != set_bits_slack; ++i) {
        out[i] = first + static_cast<std::uint32_t>(std::countr_zero(word));
        word &= word - 1;
      }
      out += set_bits_slack;
    } while (out < end);
    out = end;
  }
  return out;
}

#if defined(__x86_64__)

[[gnu::target("popcnt")]] std::size_t count_bits_popcnt(const std::uint64_t* words, std::size_t count) noexcept {
  return count_bits(words, count);
}

[[gnu::target("popcnt,bmi")]] std::uint32_t* write_bits_bmi(const std::uint64_t* words, std::size_t count,
                                                           std::uint32_t first, std::uint32_t* out) noexcept {
  return write_bits(words, count, first, out);
}

[[nodiscard]] bool has_bit_instructions() noexcept {
  static const bool has = __builtin_cpu_supports("popcnt") != 0 && __builtin_cpu_supports("bmi") != 0;
  return has;
}

#endif

}  // namespace

std::size_t count_set_bits(const std::uint64_t* words, std::size_t count) noexcept {
#if defined(__x86_64__)
  if (has_bit_instructions()) return count_bits_popcnt(words, count);
#endif
  return count_bits(words, count);
}

std::uint32_t* write_set_bits(const std::uint64_t* words, std::size_t count, std::uint32_t first,
                              std::uint32_t* out) noexcept {
#if defined(__x86_64__)
  if (has_bit_instructions()) return write_bits_bmi(words, count, first, out);
#endif
  return write_bits(words, count, first, out);
}

}  // namespace shaftcull::kernel
