// SPDX-License-Identifier: MIT
/// The set `sse4_2`: vectors of 4 floats and of 8 integers.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

// A name of its own for each set, so that none of xsimd's inline functions is shared with another one.
#define xsimd xsimd_sse4_2
#include "simd/left_packing.hpp"
#include "simd/operations.hpp"
#include "simd/portable.hpp"
#include "simd/x86/xsimd_vectors.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel::sse4_2 {

struct Set;

struct EightFloats : PortableEightFloats<Set> {
  static unsigned signs(const Vector& a) noexcept {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_loadu_ps(a.of)) | _mm_movemask_ps(_mm_loadu_ps(a.of + 4)) << 4);
  }
};

struct Integers16;

struct Floats : x86::XsimdFloats<Floats, xsimd::sse4_2> {
  using EightFloats = sse4_2::EightFloats;
  using Integers16 = sse4_2::Integers16;

  static Vector gather(const float* p, const std::uint16_t* index) noexcept {
    return _mm_setr_ps(p[index[0]], p[index[1]], p[index[2]], p[index[3]]);
  }
  static void load_columns(const void* const (&rows)[4], Vector (&columns)[4]) noexcept {
    __m128 row[4];
    for (unsigned i = 0; i < 4; ++i) row[i] = _mm_loadu_ps(static_cast<const float*>(rows[i]));
    _MM_TRANSPOSE4_PS(row[0], row[1], row[2], row[3]);
    for (unsigned c = 0; c < 4; ++c) columns[c] = row[c];
  }
  static void transpose(const Vector (&columns)[8], EightFloats::Vector (&transposed)[4]) noexcept {
    float column[8][4];
    for (unsigned c = 0; c < 8; ++c) store(column[c], columns[c]);
    for (unsigned i = 0; i < 4; ++i) {
      for (unsigned c = 0; c < 8; ++c) transposed[i].of[c] = column[c][i];
    }
  }

  class FirstLanes {
   public:
    explicit FirstLanes(int count) noexcept : count_(count) {}

    [[nodiscard]] Vector load(const float* p) const noexcept {
      if (count_ >= 4) return _mm_loadu_ps(p);
      if (count_ <= 0) return _mm_setzero_ps();
      if (count_ == 1) return _mm_load_ss(p);
      const __m128 two = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
      return count_ == 2 ? two : _mm_movelh_ps(two, _mm_load_ss(p + 2));
    }
    [[nodiscard]] Vector choose(Vector a, Vector b) const noexcept {
      const __m128i mask = _mm_cmpgt_epi32(_mm_set1_epi32(count_), _mm_setr_epi32(0, 1, 2, 3));
      return _mm_blendv_ps(b, a, _mm_castsi128_ps(mask));
    }

   private:
    int count_;
  };

  class Compressor {
   public:
    explicit Compressor(std::uint64_t bits) noexcept
        : from_(_mm_load_si128(reinterpret_cast<const __m128i*>(left_packing<4, 4>.part[bits]))) {}

    void store(float* p, Vector a) const noexcept { Floats::store(p, packed(a)); }
    void store(std::uint32_t* p, const std::uint32_t* from) const noexcept {
      const __m128i lanes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
      _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm_shuffle_epi8(lanes, from_));
    }
    void store(float* p, Vector a, std::size_t count) const noexcept {
      float lane[4];
      Floats::store(lane, packed(a));
      for (std::size_t i = 0; i < count; ++i) p[i] = lane[i];
    }

   private:
    [[nodiscard]] Vector packed(Vector a) const noexcept {
      return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(a), from_));
    }

    __m128i from_;
  };

  static Vector minimum(Vector a, Vector b) noexcept { return _mm_min_ps(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return _mm_max_ps(a, b); }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    return _mm_castsi128_ps(_mm_max_epu32(_mm_castps_si128(a), _mm_castps_si128(b)));
  }

  static std::uint64_t bits(Mask mask) noexcept { return static_cast<std::uint32_t>(_mm_movemask_ps(mask)); }
  static unsigned lowest_bit(std::uint64_t word) noexcept {
    return static_cast<unsigned>(trailing_zeros(word | std::uint64_t{1} << 63));
  }

  static std::uint64_t signs(const Vector (&of)[4]) noexcept { return signs(packed(of)); }

  using SignCollector = x86::PackedSignCollector<Floats>;

  // For the templates of xsimd_vectors.hpp.
  using PackedSigns = __m128i;
  /// The signs of four vectors, as those of bytes: packing saturates, which keeps signs.
  static __m128i packed(const Vector (&of)[4]) noexcept {
    return _mm_packs_epi16(_mm_packs_epi32(_mm_castps_si128(of[0]), _mm_castps_si128(of[1])),
                           _mm_packs_epi32(_mm_castps_si128(of[2]), _mm_castps_si128(of[3])));
  }
  static std::uint64_t signs(__m128i bytes) noexcept { return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes)); }
  template <class One>
  static __m128 folded_to_four(Vector a, One /*one*/) noexcept {
    return a;
  }
};

struct Integers16 : x86::XsimdIntegers16<Floats, xsimd::sse4_2> {
  static constexpr std::size_t fewest_shafts_on_grid = 5;
  static constexpr std::size_t fewest_tests_on_grid = 6144;

  // xsimd 8 has ssub(), but not without optimisation.
  static Vector subtract_saturated(Vector a, Vector b) noexcept { return _mm_subs_epi16(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm_mulhrs_epi16(a, b); }

  /// What 32 bits do not hold becomes the least that they do, and packing saturates.
  static void store_rounded(std::int16_t* out, const Floats::Vector (&of)[16], Vector least) noexcept {
    for (unsigned v = 0; v < 8; ++v) {
      const __m128i eight = _mm_packs_epi32(_mm_cvtps_epi32(of[2 * v]), _mm_cvtps_epi32(of[2 * v + 1]));
      _mm_store_si128(reinterpret_cast<__m128i*>(out) + v, _mm_max_epi16(eight, least));
    }
  }

  /// Packed into bytes, which saturates and so keeps what matters, negative integers are above all others as unsigned
  /// ones.
  static Outcomes outcomes(const Vector (&of)[8], Vector limit) noexcept {
    Outcomes outcomes{};
    __m128i least = _mm_set1_epi8(-1);
    for (unsigned v = 0; v < 8; v += 2) {
      const __m128i bytes = _mm_packs_epi16(of[v], of[v + 1]);
      outcomes.yes |= static_cast<std::uint64_t>(_mm_movemask_epi8(bytes)) << 8 * v;
      least = _mm_min_epu8(bytes, least);
    }
    constexpr std::uint64_t in_every_sixteen = 0x0001000100010001;
    outcomes.undecided =
        static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_min_epu8(least, limit), least))) *
        in_every_sixteen;
    return outcomes;
  }
};

static_assert(FloatOperations<Floats> && Integer16Operations<Integers16>);

}  // namespace shaftcull::kernel::sse4_2
