/// Eight floats of one thing in an AVX2 register: the coordinates of a box, the constraints or planes of a shaft.
///
/// Of a mask only the signs of lanes count: negative lanes are meant. As in lanes.hpp, functions are templates on an architecture that only one
/// translation unit uses.
#pragma once

#ifdef __AVX2__
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace shaftcull::kernel {

template <class Arch>
struct Eight {
  using Vector = __m256;
  using Mask = __m256;
  using Order = __m256i;

  static Vector all(float a) noexcept { return _mm256_set1_ps(a); }
  static Vector load(const float* from) noexcept { return _mm256_loadu_ps(from); }
  /// Six floats, and `rest` in lanes 6 and 7.
  static Vector load_six(const float* from, float rest) noexcept {
    const __m256 four = _mm256_castps128_ps256(_mm_loadu_ps(from));
    const __m128 two = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + 4)));
    return _mm256_insertf128_ps(four, _mm_movelh_ps(two, _mm_set1_ps(rest)), 1);
  }
  /// Element i of six streams; of the fourth once more in lane 6, and of the first in lane 7.
  static Vector gather(const float* const* stream, std::size_t i) noexcept {
    const auto at = [&](unsigned s) { return _mm256_broadcast_ss(stream[s] + i); };
    const __m256 first = _mm256_blend_ps(at(0), at(1), 1 << 1);
    const __m256 second = _mm256_blend_ps(at(2), at(3), 1 << 3 | 1 << 6);
    const __m256 third = _mm256_blend_ps(at(4), at(5), 1 << 5);
    return _mm256_blend_ps(_mm256_blend_ps(first, second, 1 << 2 | 1 << 3 | 1 << 6), third, 1 << 4 | 1 << 5);
  }
  /// The larger one in lane 6, the smaller one in lane 7.
  static Vector sorted_last_two(float a, float b) noexcept {
    const __m256 x = all(a);
    const __m256 y = all(b);
    return _mm256_blend_ps(_mm256_max_ps(x, y), _mm256_min_ps(x, y), 1 << 7);
  }

  /// Lanes 0 … count − 1.
  static Mask first(unsigned count) noexcept { return below(count, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)); }
  /// Lanes 0 … count − 1, at most six, and lane 6.
  static Mask first_and_seventh(unsigned count) noexcept { return below(count, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, -1, 7)); }
  static Mask less_equal(Vector a, Vector b) noexcept { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
  static Mask both(Mask a, Mask b) noexcept { return _mm256_and_ps(a, b); }
  /// Bit i is the sign of lane i.
  static unsigned signs(Vector a) noexcept { return static_cast<unsigned>(_mm256_movemask_ps(a)); }

  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return _mm256_blendv_ps(b, a, mask); }
  /// a, with lane 6 of b.
  static Vector with_seventh(Vector a, Vector b) noexcept { return _mm256_blend_ps(a, b, 1 << 6); }
  /// a, with lanes 6 and 7 of b.
  static Vector with_last_two(Vector a, Vector b) noexcept { return _mm256_blend_ps(a, b, 1 << 6 | 1 << 7); }
  /// Where the lanes of a permuted vector come from.
  static Order order(const std::uint8_t* from) noexcept {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
  }
  static Vector permuted(Vector a, Order order) noexcept { return _mm256_permutevar8x32_ps(a, order); }

  static Vector add(Vector a, Vector b) noexcept { return _mm256_add_ps(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return _mm256_sub_ps(a, b); }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
  /// a, negated in lanes 3 to 5.
  static Vector negate_hi(Vector a) noexcept { return _mm256_xor_ps(a, _mm256_setr_ps(0, 0, 0, -0.0F, -0.0F, -0.0F, 0, 0)); }
  /// a, negated in lanes that are not in the mask.
  static Vector negate_unless(Mask mask, Vector a) noexcept { return _mm256_xor_ps(a, _mm256_andnot_ps(mask, all(-0.0F))); }
  /// a, but +∞ where it is NaN.
  static Vector infinite_if_nan(Vector a) noexcept { return _mm256_min_ps(a, all(__builtin_inff())); }
  /// The smaller of the bit patterns, as unsigned integers: negative floats are above all others.
  static Vector minimum_of_bits(Vector a, Vector b) noexcept {
    return _mm256_castsi256_ps(_mm256_min_epu32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
  }
  /// The smallest lane of a + the smallest lane of b.
  static float sum_of_smallest(Vector a, Vector b) noexcept {
    const __m128 a4 = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 b4 = _mm_min_ps(_mm256_castps256_ps128(b), _mm256_extractf128_ps(b, 1));
    const __m128 pairs = _mm_min_ps(_mm_unpacklo_ps(a4, b4), _mm_unpackhi_ps(a4, b4));
    const __m128 smallest = _mm_min_ps(pairs, _mm_movehl_ps(pairs, pairs));
    return _mm_cvtss_f32(_mm_add_ss(smallest, _mm_shuffle_ps(smallest, smallest, 1)));
  }

 private:
  static Mask below(unsigned count, __m256i lane) noexcept {
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane));
  }
};

}  // namespace shaftcull::kernel
#endif
