// SPDX-License-Identifier: MIT
/// The set `avx512` (F, CD, DQ, BW and VL): vectors of 16 floats and of 32 integers.
///
/// Shafts are formed with vectors of 8, since transposing goes by eight: that is a quarter faster.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

// A name of its own for each set, so that none of xsimd's inline functions is shared with another one.
#define xsimd xsimd_avx512
#include "simd/operations.hpp"
#include "simd/x86/vectors_of_8.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel::avx512 {

struct Set;
using EightFloats = x86::EightFloatsOf<Set>;
using FormationFloats = x86::FloatsOf<Set>;

struct Integers16;

struct Floats : x86::XsimdFloats<Floats, xsimd::avx512bw> {
  using EightFloats = avx512::EightFloats;
  using Integers16 = avx512::Integers16;

  static Vector gather(const float* p, const std::uint16_t* index) noexcept {
    const __m256i sixteen = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
    return _mm512_i32gather_ps(_mm512_cvtepu16_epi32(sixteen), p, sizeof(float));
  }
  static void load_columns(const void* const (&rows)[16], Vector (&columns)[4]) noexcept {
    const void* low[8];
    const void* high[8];
    for (unsigned i = 0; i < 8; ++i) {
      low[i] = rows[i];
      high[i] = rows[i + 8];
    }
    FormationFloats::Vector low_columns[4];
    FormationFloats::Vector high_columns[4];
    FormationFloats::load_columns(low, low_columns);
    FormationFloats::load_columns(high, high_columns);
    for (unsigned c = 0; c < 4; ++c) {
      columns[c] = _mm512_insertf32x8(_mm512_castps256_ps512(low_columns[c]), high_columns[c], 1);
    }
  }
  static void transpose(const Vector (&columns)[8], __m256 (&transposed)[16]) noexcept {
    __m256 low[8];
    __m256 high[8];
    for (unsigned c = 0; c < 8; ++c) {
      low[c] = lower_half(columns[c]);
      high[c] = upper_half(columns[c]);
    }
    EightFloats::transpose(low, transposed);
    EightFloats::transpose(high, transposed + 8);
  }

  class FirstLanes {
   public:
    explicit FirstLanes(int count) noexcept
        : mask_(static_cast<__mmask16>(_bzhi_u32(0xffffU, count < 0 ? 0U : static_cast<unsigned>(count)))) {}

    [[nodiscard]] Vector load(const float* p) const noexcept { return _mm512_maskz_loadu_ps(mask_, p); }
    [[nodiscard]] Vector choose(Vector a, Vector b) const noexcept { return _mm512_mask_mov_ps(b, mask_, a); }

   private:
    __mmask16 mask_;
  };

  class Compressor {
   public:
    explicit Compressor(std::uint64_t bits) noexcept {
      const __m512i all = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
      from_ = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), all);
    }

    void store(float* p, Vector a) const noexcept { Floats::store(p, packed(a)); }
    void store(std::uint32_t* p, const std::uint32_t* from) const noexcept {
      _mm512_storeu_si512(p, _mm512_permutexvar_epi32(from_, _mm512_loadu_si512(from)));
    }
    void store(float* p, Vector a, std::size_t count) const noexcept {
      _mm512_mask_storeu_ps(p, static_cast<__mmask16>((1U << count) - 1), packed(a));
    }

   private:
    [[nodiscard]] Vector packed(Vector a) const noexcept { return _mm512_permutexvar_ps(from_, a); }

    __m512i from_;
  };

  /// The bits of those in `mask`, side by side; and back.
  static std::uint64_t packed_bits(std::uint64_t bits, std::uint64_t mask) noexcept { return _pext_u64(bits, mask); }
  static std::uint64_t spread_bits(std::uint64_t bits, std::uint64_t mask) noexcept { return _pdep_u64(bits, mask); }

  // xsimd 8 multiplies, and then adds.
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm512_fmadd_ps(a, b, c); }
  static Vector minimum(Vector a, Vector b) noexcept { return _mm512_min_ps(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return _mm512_max_ps(a, b); }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    return _mm512_castsi512_ps(_mm512_max_epu32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
  }

  static std::uint64_t bits(Mask mask) noexcept { return static_cast<__mmask16>(mask); }
  static unsigned lowest_bit(std::uint64_t word) noexcept { return static_cast<unsigned>(_tzcnt_u64(word)); }

  /// Packing saturates, which keeps signs. It works on quarters, whose fours of bytes are then put in order.
  static std::uint64_t signs(const Vector (&of)[4]) noexcept {
    const __m512i bytes =
        _mm512_packs_epi16(_mm512_packs_epi32(_mm512_castps_si512(of[0]), _mm512_castps_si512(of[1])),
                           _mm512_packs_epi32(_mm512_castps_si512(of[2]), _mm512_castps_si512(of[3])));
    const __m512i order = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
    return _mm512_movepi8_mask(_mm512_permutexvar_epi32(order, bytes));
  }

  /// Comparisons make masks here, which are quicker combined than packed.
  class SignCollector {
   public:
    explicit SignCollector(Vector limit) noexcept : limit_(limit) {}

    std::uint64_t collect(const Vector (&of)[4]) noexcept {
      for (const Vector& v : of) {  // as unsigned integers, negative floats are above all others
        undecided_ |= _mm512_cmple_epu32_mask(_mm512_castps_si512(v), _mm512_castps_si512(limit_));
      }
      return signs(of);
    }
    [[nodiscard]] bool any_undecided() const noexcept { return undecided_ != 0; }

   private:
    Vector limit_;
    std::uint32_t undecided_ = 0;
  };

  /// Lists the positions of set bits by VBMI2, which packs those of a word in one instruction. This set does not ask
  /// for VBMI2: this is the one place that asks the processor itself.
  struct PositionCompressor {
    static constexpr unsigned at_once = 16;
    static bool is_available() noexcept { return SHAFTCULL_PROCESSOR_HAS("avx512vbmi2"); }

    /// Writes 64 w + i for every set bit i of every word w, ascending, and up to 16 positions that are none.
    SHAFTCULL_NOINLINE SHAFTCULL_TARGET("avx512vbmi2") static void write(const std::uint64_t* words, std::size_t count,
                                                                         std::uint32_t* out) noexcept {
      alignas(64) std::uint8_t in_order[64];
      for (unsigned i = 0; i != 64; ++i) in_order[i] = static_cast<std::uint8_t>(i);
      const __m512i all = _mm512_load_si512(in_order);
      __m512i first = _mm512_setzero_si512();
      for (std::size_t w = 0; w != count; ++w) {
        __m512i packed = _mm512_maskz_compress_epi8(words[w], all);
        std::uint32_t* const end = out + popcount(words[w]);
        do {
          // Masks of all lanes: GCC 12 warns of what its unmasked intrinsics leave undefined (GCC bug 105593).
          const __m512i sixteen = _mm512_maskz_cvtepu8_epi32(0xffff, _mm512_maskz_extracti32x4_epi32(0xf, packed, 0));
          _mm512_storeu_si512(out, _mm512_add_epi32(sixteen, first));
          packed = _mm512_maskz_alignr_epi64(0xff, packed, packed, 2);
          out += at_once;
        } while (out < end);
        out = end;
        first = _mm512_add_epi32(first, _mm512_set1_epi32(64));
      }
    }
  };

  // For the templates of xsimd_vectors.hpp.
  template <class One>
  static __m128 folded_to_four(Vector a, One one) noexcept {
    const auto fours_of = [&](__m256 half) {
      return one(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1));
    };
    return one(fours_of(lower_half(a)), fours_of(upper_half(a)));
  }

 private:
  static __m256 lower_half(Vector a) noexcept { return _mm512_castps512_ps256(a); }
  static __m256 upper_half(Vector a) noexcept { return _mm512_extractf32x8_ps(a, 1); }
};

struct Integers16 : x86::XsimdIntegers16<Floats, xsimd::avx512bw> {
  static constexpr std::size_t fewest_shafts_on_grid = 8;  // floats are quick here
  static constexpr std::size_t fewest_tests_on_grid = 16384;

  // xsimd 8 has ssub(), but not without optimisation.
  static Vector subtract_saturated(Vector a, Vector b) noexcept { return _mm512_subs_epi16(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm512_mulhrs_epi16(a, b); }

  /// What 32 bits do not hold becomes the least that they do, and converting saturates.
  static void store_rounded(std::int16_t* out, const Floats::Vector (&of)[4], Vector least) noexcept {
    for (unsigned v = 0; v < 4; ++v) {
      const __m256i sixteen = _mm512_cvtsepi32_epi16(_mm512_cvtps_epi32(of[v]));
      _mm256_store_si256(reinterpret_cast<__m256i*>(out) + v, _mm256_max_epi16(sixteen, _mm512_castsi512_si256(least)));
    }
  }

  static Outcomes outcomes(const Vector (&of)[2], Vector limit) noexcept {
    const __m512i wide = _mm512_srli_epi16(limit, 8);
    return {_mm512_movepi16_mask(of[0]) | std::uint64_t{_mm512_movepi16_mask(of[1])} << 32,
            _mm512_cmple_epu16_mask(of[0], wide) | std::uint64_t{_mm512_cmple_epu16_mask(of[1], wide)} << 32};
  }
};

static_assert(FloatOperations<Floats> && FloatOperations<FormationFloats> && Integer16Operations<Integers16>);

}  // namespace shaftcull::kernel::avx512
