/// Copies of each loop: for any processor, for x86-64 with POPCNT and BMI1, and, of writing, for AVX-512 with VBMI2,
/// which packs the positions of a word in one instruction.
///
/// A loop "while the word is not zero" is a mispredicted branch a word. So, as in simdjson (Langdale and Lemire,
/// "Parsing Gigabytes of JSON per Second", 2019), a fixed number of positions is always written, and the end moves
/// on by the number of set bits; only a word with more of them takes a branch. That number follows from how many
/// bits are set on average. It needs a TZCNT that knows zero, which the portable copy cannot count on.
#include "kernels/set_bits.hpp"

#include <bit>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace shaftcull::kernel {
namespace {

#if defined(__x86_64__)

[[gnu::target("popcnt")]] std::size_t count_with_popcnt(const std::uint64_t* words, std::size_t count) noexcept {
  std::size_t bits = 0;
  for (std::size_t w = 0; w != count; ++w) bits += static_cast<std::size_t>(__builtin_popcountll(words[w]));
  return bits;
}

/// Always writes 16 positions of a word, and then as many more as it takes.
[[gnu::target("popcnt,avx512f,avx512bw,avx512vbmi2")]] void write_with_compress(const std::uint64_t* words,
                                                                                std::size_t count, std::size_t set,
                                                                                std::uint32_t* out) noexcept {
  static_assert(set_bits_slack >= 16);
  if (set == 0) return;
  alignas(64) std::uint8_t in_order[64];
  for (std::size_t i = 0; i != 64; ++i) in_order[i] = static_cast<std::uint8_t>(i);
  const __m512i all = _mm512_load_si512(in_order);
  __m512i first = _mm512_setzero_si512();
  for (std::size_t w = 0; w != count; ++w) {
    __m512i packed = _mm512_maskz_compress_epi8(words[w], all);
    std::uint32_t* const end = out + __builtin_popcountll(words[w]);
    do {
      // Masks of all lanes: GCC 12 warns of what its unmasked intrinsics leave undefined (GCC bug 105593).
      const __m512i sixteen = _mm512_maskz_cvtepu8_epi32(0xffff, _mm512_maskz_extracti32x4_epi32(0xf, packed, 0));
      _mm512_storeu_si512(out, _mm512_add_epi32(sixteen, first));
      packed = _mm512_maskz_alignr_epi64(0xff, packed, packed, 2);
      out += 16;
    } while (out < end);
    out = end;
    first = _mm512_add_epi32(first, _mm512_set1_epi32(64));
  }
}

/// Always writes `step` positions of a word, and then as many more as it takes.
template <std::size_t step>
[[gnu::target("popcnt,bmi")]] void write_with_tzcnt(const std::uint64_t* words, std::size_t count,
                                                    std::uint32_t* out) noexcept {
  static_assert(step <= set_bits_slack);
  std::uint32_t first = 0;
  for (std::size_t w = 0; w != count; ++w, first += 64) {
    std::uint64_t word = words[w];
    std::uint32_t* const end = out + __builtin_popcountll(word);
    do {
#pragma GCC unroll 16
      for (std::size_t i = 0; i != step; ++i) {
        out[i] = first + static_cast<std::uint32_t>(_tzcnt_u64(word));
        word &= word - 1;
      }
      out += step;
    } while (out < end);
    out = end;
  }
}

void write_with_bmi(const std::uint64_t* words, std::size_t count, std::size_t set, std::uint32_t* out) noexcept {
  if (set == 0) return;
  // A word of evenly spread bits needs more than one step about once in fifty.
  if (2 * set <= count) return write_with_tzcnt<2>(words, count, out);
  if (set <= count) return write_with_tzcnt<3>(words, count, out);
  if (set <= 2 * count) return write_with_tzcnt<5>(words, count, out);
  if (set <= 4 * count) return write_with_tzcnt<8>(words, count, out);
  return write_with_tzcnt<16>(words, count, out);
}

constexpr SetBits with_bmi{count_with_popcnt, write_with_bmi};
constexpr SetBits with_compress{count_with_popcnt, write_with_compress};

[[nodiscard]] bool has_bmi() noexcept {
  static const bool has = __builtin_cpu_supports("popcnt") != 0 && __builtin_cpu_supports("bmi") != 0;
  return has;
}

[[nodiscard]] bool has_compress() noexcept {
  static const bool has = __builtin_cpu_supports("avx512vbmi2") != 0;
  return has;
}

#endif

std::size_t count_portably(const std::uint64_t* words, std::size_t count) noexcept {
  std::size_t bits = 0;
  for (std::size_t w = 0; w != count; ++w) bits += static_cast<std::size_t>(std::popcount(words[w]));
  return bits;
}

void write_portably(const std::uint64_t* words, std::size_t count, std::size_t /*set*/, std::uint32_t* out) noexcept {
  std::uint32_t first = 0;
  for (std::size_t w = 0; w != count; ++w, first += 64) {
    for (std::uint64_t word = words[w]; word != 0; word &= word - 1) {
      *out++ = first + static_cast<std::uint32_t>(std::countr_zero(word));
    }
  }
}

constexpr SetBits portable{count_portably, write_portably};

}  // namespace

const SetBits& set_bits_of([[maybe_unused]] const Kernels& kernels) noexcept {
#if defined(__x86_64__)
  if (kernels.width == 16 && has_compress()) return with_compress;
  if (kernels.width > 1 && has_bmi()) return with_bmi;
#endif
  return portable;
}

}  // namespace shaftcull::kernel
