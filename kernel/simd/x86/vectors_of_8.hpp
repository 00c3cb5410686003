// SPDX-License-Identifier: MIT
/// What AVX2 and AVX-512 share: vectors of 8 floats, with FMA, BMI and BMI2. AVX-512 forms shafts with them, and holds
/// one box or the constraints of one shaft in them.
///
/// Templates on the set that uses them: each set is compiled with flags of its own and has functions of its own. The
/// header of a set names xsimd before it includes this.
#pragma once

#include <immintrin.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "simd/left_packing.hpp"
#include "simd/x86/xsimd_vectors.hpp"

namespace shaftcull::kernel::x86 {

template <class Set>
struct EightFloatsOf {
  using Vector = __m256;
  using Mask = __m256;
  using Order = __m256i;
  struct Three {
    float of[3];
  };
  static constexpr bool in_one_register = true;

  static Vector all(float a) noexcept { return _mm256_set1_ps(a); }
  static Vector load(const void* from) noexcept { return _mm256_loadu_ps(static_cast<const float*>(from)); }
  static Vector load_six(const float* from, float rest) noexcept {
    const __m256 four = _mm256_castps128_ps256(_mm_loadu_ps(from));
    const __m128 two = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + 4)));
    return _mm256_insertf128_ps(four, _mm_movelh_ps(two, _mm_set1_ps(rest)), 1);
  }
  static Vector load_faces(const void* box) noexcept {
    const auto* const faces = static_cast<const float*>(box);
    double last_two;
    std::memcpy(&last_two, faces + 4, sizeof last_two);
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(faces)), _mm_castpd_ps(_mm_set1_pd(last_two)), 1);
  }
  static void store(void* to, Vector a) noexcept { _mm256_storeu_ps(static_cast<float*>(to), a); }
  static Vector first_in_all(Vector a) noexcept { return _mm256_broadcastss_ps(_mm256_castps256_ps128(a)); }
  static float first(Vector a) noexcept { return _mm256_cvtss_f32(a); }
  static Vector pair_in_all(float even, float odd) noexcept {
    const __m128 pair = _mm_unpacklo_ps(_mm_set_ss(even), _mm_set_ss(odd));
    return _mm256_castpd_ps(_mm256_broadcastsd_pd(_mm_castps_pd(pair)));
  }
  static Vector gather(const float* const* stream, std::size_t i) noexcept {
    const auto at = [&](unsigned s) { return _mm256_broadcast_ss(stream[s] + i); };
    const __m256 first = _mm256_blend_ps(at(0), at(1), 1 << 1);
    const __m256 second = _mm256_blend_ps(at(2), at(3), 1 << 3 | 1 << 6);
    const __m256 third = _mm256_blend_ps(at(4), at(5), 1 << 5);
    return _mm256_blend_ps(_mm256_blend_ps(first, second, 1 << 2 | 1 << 3 | 1 << 6), third, 1 << 4 | 1 << 5);
  }
  static Vector sorted_last_two(float a, float b) noexcept {
    const __m256 x = all(a);
    const __m256 y = all(b);
    return _mm256_blend_ps(_mm256_max_ps(x, y), _mm256_min_ps(x, y), 1 << 7);
  }

  static Mask first(unsigned count) noexcept { return below(count, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)); }
  static Mask first_and_seventh(unsigned count) noexcept {
    return below(count, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, -1, 7));
  }
  static Mask less_equal(Vector a, Vector b) noexcept { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
  static Mask both(Mask a, Mask b) noexcept { return _mm256_and_ps(a, b); }
  static unsigned signs(Vector a) noexcept { return static_cast<unsigned>(_mm256_movemask_ps(a)); }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return _mm256_blendv_ps(b, a, mask); }

  static Vector with_seventh(Vector a, Vector b) noexcept { return _mm256_blend_ps(a, b, 1 << 6); }
  static Vector with_last_two(Vector a, Vector b) noexcept { return _mm256_blend_ps(a, b, 1 << 6 | 1 << 7); }
  static Order order(const void* from) noexcept {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(static_cast<const __m128i*>(from)));
  }
  static Vector permuted(Vector a, Order order) noexcept { return _mm256_permutevar8x32_ps(a, order); }
  static Vector permuted(Vector a, const std::uint32_t (&from)[8]) noexcept {
    return permuted(a, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
  }

  static Vector add(Vector a, Vector b) noexcept { return _mm256_add_ps(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return _mm256_sub_ps(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm256_mul_ps(a, b); }
  static Vector divide(Vector a, Vector b) noexcept { return _mm256_div_ps(a, b); }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
  static Vector maximum(Vector a, Vector b) noexcept { return _mm256_max_ps(a, b); }
  static Vector magnitude(Vector a) noexcept { return _mm256_andnot_ps(all(-0.0F), a); }
  static Vector minus_magnitude(Vector a) noexcept { return _mm256_or_ps(all(-0.0F), a); }
  static Vector negate_hi(Vector a) noexcept {
    return _mm256_xor_ps(a, _mm256_setr_ps(0, 0, 0, -0.0F, -0.0F, -0.0F, 0, 0));
  }
  static Vector negate_unless(Mask mask, Vector a) noexcept {
    return _mm256_xor_ps(a, _mm256_andnot_ps(mask, all(-0.0F)));
  }
  static Vector infinite_if_nan(Vector a) noexcept { return _mm256_min_ps(a, all(INFINITY)); }
  static Vector minimum_of_bits(Vector a, Vector b) noexcept {
    return _mm256_castsi256_ps(_mm256_min_epu32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
  }
  static float sum_of_smallest(Vector a, Vector b) noexcept {
    const __m128 a4 = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 b4 = _mm_min_ps(_mm256_castps256_ps128(b), _mm256_extractf128_ps(b, 1));
    const __m128 pairs = _mm_min_ps(_mm_unpacklo_ps(a4, b4), _mm_unpackhi_ps(a4, b4));
    const __m128 smallest = _mm_min_ps(pairs, _mm_movehl_ps(pairs, pairs));
    return _mm_cvtss_f32(_mm_add_ss(smallest, _mm_shuffle_ps(smallest, smallest, 1)));
  }
  static Three largest_of_three(Vector a, Vector b, Vector c) noexcept {
    const auto half = [](Vector x) { return _mm_max_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1)); };
    const auto paired = [](__m128 x, __m128 y) { return _mm_max_ps(_mm_unpacklo_ps(x, y), _mm_unpackhi_ps(x, y)); };
    const __m128 c4 = half(c);
    const __m128 a_and_b = paired(half(a), half(b));
    const __m128 c_twice = paired(c4, c4);
    const __m128 largest = _mm_max_ps(_mm_movelh_ps(a_and_b, c_twice), _mm_movehl_ps(c_twice, a_and_b));
    return {{_mm_cvtss_f32(largest), _mm_cvtss_f32(_mm_movehdup_ps(largest)),
             _mm_cvtss_f32(_mm_movehl_ps(largest, largest))}};
  }
  static bool is_ordered(Vector faces) noexcept {
    const __m128i first_four = _mm_castps_si128(_mm256_castps256_ps128(faces));
    const __m128i last_four = _mm_castps_si128(_mm256_extractf128_ps(faces, 1));
    const __m128 hi = _mm_castsi128_ps(_mm_alignr_epi8(last_four, first_four, 3 * sizeof(float)));
    return (_mm_movemask_ps(_mm_cmple_ps(_mm_castsi128_ps(first_four), hi)) & 7) == 7;
  }

  /// Lane i of the eight columns becomes rows[i]: in pairs, then fours, then halves.
  static void transpose(const Vector (&columns)[8], Vector* rows) noexcept {
    __m256 pair[8];
    for (unsigned c = 0; c < 8; c += 2) {
      pair[c] = _mm256_unpacklo_ps(columns[c], columns[c + 1]);
      pair[c + 1] = _mm256_unpackhi_ps(columns[c], columns[c + 1]);
    }
    __m256 four[8];
    for (unsigned i = 0; i < 8; i += 4) {
      four[i] = _mm256_shuffle_ps(pair[i], pair[i + 2], 0x44);
      four[i + 1] = _mm256_shuffle_ps(pair[i], pair[i + 2], 0xee);
      four[i + 2] = _mm256_shuffle_ps(pair[i + 1], pair[i + 3], 0x44);
      four[i + 3] = _mm256_shuffle_ps(pair[i + 1], pair[i + 3], 0xee);
    }
    for (unsigned i = 0; i < 4; ++i) {
      rows[i] = _mm256_permute2f128_ps(four[i], four[i + 4], 0x20);
      rows[i + 4] = _mm256_permute2f128_ps(four[i], four[i + 4], 0x31);
    }
  }

 private:
  static Mask below(unsigned count, __m256i lane) noexcept {
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane));
  }
};

template <class Set>
struct FloatsOf : XsimdFloats<FloatsOf<Set>, xsimd::fma3<xsimd::avx2>> {
  using Shared = XsimdFloats<FloatsOf, xsimd::fma3<xsimd::avx2>>;
  using typename Shared::Mask;
  using typename Shared::Vector;
  using EightFloats = EightFloatsOf<Set>;

  static Vector gather(const float* p, const std::uint16_t* index) noexcept {
    const __m128i eight = _mm_loadu_si128(reinterpret_cast<const __m128i*>(index));
    return _mm256_i32gather_ps(p, _mm256_cvtepu16_epi32(eight), sizeof(float));
  }
  static void load_columns(const void* const (&rows)[8], Vector (&columns)[4]) noexcept {
    __m256 row[4];  // i, and i + 4 in the upper half
    const auto four_at = [&](unsigned i) { return _mm_loadu_ps(static_cast<const float*>(rows[i])); };
    for (unsigned i = 0; i < 4; ++i) {
      row[i] = _mm256_insertf128_ps(_mm256_castps128_ps256(four_at(i)), four_at(i + 4), 1);
    }
    const __m256 first[2] = {_mm256_unpacklo_ps(row[0], row[1]), _mm256_unpacklo_ps(row[2], row[3])};
    const __m256 last[2] = {_mm256_unpackhi_ps(row[0], row[1]), _mm256_unpackhi_ps(row[2], row[3])};
    columns[0] = _mm256_shuffle_ps(first[0], first[1], 0x44);
    columns[1] = _mm256_shuffle_ps(first[0], first[1], 0xee);
    columns[2] = _mm256_shuffle_ps(last[0], last[1], 0x44);
    columns[3] = _mm256_shuffle_ps(last[0], last[1], 0xee);
  }
  static void transpose(const Vector (&columns)[8], __m256 (&transposed)[8]) noexcept {
    const __m256 eight[8] = {columns[0], columns[1], columns[2], columns[3],
                             columns[4], columns[5], columns[6], columns[7]};
    EightFloats::transpose(eight, transposed);
  }

  class FirstLanes {
   public:
    explicit FirstLanes(int count) noexcept : mask_(_mm256_cmpgt_epi32(_mm256_set1_epi32(count), numbers())) {}

    [[nodiscard]] Vector load(const float* p) const noexcept { return _mm256_maskload_ps(p, mask_); }
    [[nodiscard]] Vector choose(Vector a, Vector b) const noexcept {
      return _mm256_blendv_ps(b, a, _mm256_castsi256_ps(mask_));
    }

   private:
    __m256i mask_;
  };

  class Compressor {
   public:
    explicit Compressor(std::uint64_t bits) noexcept
        : from_(
              _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(left_packing<8, 1>.part[bits])))) {}

    void store(float* p, Vector a) const noexcept { FloatsOf::store(p, packed(a)); }
    void store(std::uint32_t* p, const std::uint32_t* from) const noexcept {
      const __m256i lanes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permutevar8x32_epi32(lanes, from_));
    }
    void store(float* p, Vector a, std::size_t count) const noexcept {
      const __m256i mask = _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), numbers());
      _mm256_maskstore_ps(p, mask, packed(a));
    }

   private:
    [[nodiscard]] Vector packed(Vector a) const noexcept { return _mm256_permutevar8x32_ps(a, from_); }

    __m256i from_;
  };

  static Vector minimum(Vector a, Vector b) noexcept { return _mm256_min_ps(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return _mm256_max_ps(a, b); }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    return _mm256_castsi256_ps(_mm256_max_epu32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
  }

  static std::uint64_t bits(Mask mask) noexcept { return static_cast<std::uint32_t>(_mm256_movemask_ps(mask)); }
  static unsigned lowest_bit(std::uint64_t word) noexcept { return static_cast<unsigned>(_tzcnt_u64(word)); }

  static std::uint64_t signs(const Vector (&of)[4]) noexcept { return signs(packed(of)); }

  using SignCollector = PackedSignCollector<FloatsOf>;

  // For the templates of xsimd_vectors.hpp.
  using PackedSigns = __m256i;
  /// The signs of four vectors, as those of bytes in another order: packing saturates, which keeps signs.
  static __m256i packed(const Vector (&of)[4]) noexcept {
    return _mm256_packs_epi16(_mm256_packs_epi32(_mm256_castps_si256(of[0]), _mm256_castps_si256(of[1])),
                              _mm256_packs_epi32(_mm256_castps_si256(of[2]), _mm256_castps_si256(of[3])));
  }
  /// Packing works on halves: fours of lanes 0–3 come before fours of lanes 4–7.
  static std::uint64_t signs(__m256i bytes) noexcept {
    const __m256i order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
    return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permutevar8x32_epi32(bytes, order)));
  }
  template <class One>
  static __m128 folded_to_four(Vector a, One one) noexcept {
    return one(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
  }

 private:
  static __m256i numbers() noexcept { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
};

}  // namespace shaftcull::kernel::x86
