// SPDX-License-Identifier: MIT
/// The set `sse4_2`: vectors of 4 floats and of 8 integers.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

// A name of its own for each set, so that none of xsimd's inline functions is shared with another one.
#define xsimd xsimd_sse4_2
#include <xsimd/xsimd.hpp>

#include "simd/left_packing.hpp"
#include "simd/operations.hpp"
#include "simd/portable.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel::sse4_2 {

struct Set;

struct EightFloats : PortableEightFloats<Set> {
  static unsigned signs(const Vector& a) noexcept {
    return static_cast<unsigned>(_mm_movemask_ps(_mm_loadu_ps(a.of)) | _mm_movemask_ps(_mm_loadu_ps(a.of + 4)) << 4);
  }
};

struct Integers16;

struct Floats {
  using Vector = xsimd::batch<float, xsimd::sse4_2>;
  using Mask = xsimd::batch_bool<float, xsimd::sse4_2>;
  using EightFloats = sse4_2::EightFloats;
  using Integers16 = sse4_2::Integers16;
  static constexpr unsigned width = 4;

  static Vector load(const float* p) noexcept { return Vector::load_unaligned(p); }
  static void store(float* p, Vector a) noexcept { a.store_unaligned(p); }
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

  static Vector all(float a) noexcept { return Vector(a); }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector square_root(Vector a) noexcept { return xsimd::sqrt(a); }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return xsimd::fma(a, b, c); }
  // Not by xsimd, whose min() and max() give the first of two equal values or if either is NaN from version 14 on, and
  // before that the second.
  static Vector minimum(Vector a, Vector b) noexcept { return _mm_min_ps(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return _mm_max_ps(a, b); }
  static Vector minimum_of_computed(Vector a, Vector b) noexcept { return minimum(a, b); }
  static Vector maximum_of_computed(Vector a, Vector b) noexcept { return maximum(a, b); }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    return _mm_castsi128_ps(_mm_max_epu32(_mm_castps_si128(a), _mm_castps_si128(b)));
  }
  static Vector magnitude(Vector a) noexcept { return xsimd::abs(a); }
  static Vector floor(Vector a) noexcept { return xsimd::floor(a); }
  static Vector flip_sign(Vector a, Vector b) noexcept { return a ^ b; }
  static float smallest(Vector a) noexcept {
    const __m128 pairs = _mm_min_ps(a, _mm_movehl_ps(a, a));
    return _mm_cvtss_f32(_mm_min_ps(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }
  static float largest(Vector a) noexcept {
    const __m128 pairs = _mm_max_ps(a, _mm_movehl_ps(a, a));
    return _mm_cvtss_f32(_mm_max_ps(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }

  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Mask both(Mask a, Mask b) noexcept { return a & b; }
  static Mask either(Mask a, Mask b) noexcept { return a | b; }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return xsimd::select(mask, a, b); }
  static std::uint64_t bits(Mask mask) noexcept { return static_cast<std::uint32_t>(_mm_movemask_ps(mask)); }
  static unsigned lowest_bit(std::uint64_t word) noexcept {
    return static_cast<unsigned>(trailing_zeros(word | std::uint64_t{1} << 63));
  }

  static Vector either_negative(Vector a, Vector b) noexcept { return xsimd::select(b < Vector(0.0F), b, a); }
  static std::uint64_t signs(const Vector (&of)[4]) noexcept { return signs(packed(of)); }

  /// Signs of four vectors are packed into one and read at once: each vector read by itself would take a port of the
  /// arithmetic, and so would a comparison.
  class SignCollector {
   public:
    explicit SignCollector(Vector limit) noexcept : limit_(limit) {}

    std::uint64_t collect(const Vector (&of)[4]) noexcept {
      const Vector beyond[4] = {limit_ - of[0], limit_ - of[1], limit_ - of[2], limit_ - of[3]};
      const __m128i yes = packed(of);
      decided_ = _mm_and_si128(decided_, _mm_or_si128(yes, packed(beyond)));
      return signs(yes);
    }
    [[nodiscard]] bool any_undecided() const noexcept { return signs(decided_) != 0xffff; }

   private:
    Vector limit_;
    __m128i decided_ = _mm_set1_epi32(-1);
  };

 private:
  /// The signs of four vectors, as those of bytes: packing saturates, which keeps signs.
  static __m128i packed(const Vector (&of)[4]) noexcept {
    return _mm_packs_epi16(_mm_packs_epi32(_mm_castps_si128(of[0]), _mm_castps_si128(of[1])),
                           _mm_packs_epi32(_mm_castps_si128(of[2]), _mm_castps_si128(of[3])));
  }
  static std::uint64_t signs(__m128i bytes) noexcept { return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes)); }
};

struct Integers16 {
  using Floats = sse4_2::Floats;
  using Vector = xsimd::batch<std::int16_t, xsimd::sse4_2>;
  static constexpr unsigned width = 8;
  static constexpr unsigned vectors = 8;
  static constexpr std::size_t fewest_shafts_on_grid = 5;
  static constexpr std::size_t fewest_tests_on_grid = 6144;

  static Vector load(const std::int16_t* p) noexcept { return Vector::load_aligned(p); }
  static Vector all(std::int16_t a) noexcept { return Vector(a); }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector minimum(Vector a, Vector b) noexcept { return xsimd::min(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return xsimd::max(a, b); }
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
