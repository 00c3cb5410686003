/// Eight floats of one thing in an AVX2 register: the coordinates of a box, the constraints or planes of a shaft.
///
/// Of a mask only the signs of lanes count: negative lanes are meant. As in lanes.hpp, functions are templates on an
/// architecture that only one translation unit uses.
#pragma once

#ifdef SHAFTCULL_UNIT_AVX2
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
  /// The six faces of a box; the last two once more in lanes 6 and 7.
  static Vector load_faces(const void* box) noexcept {
    const auto* const faces = static_cast<const float*>(box);
    const __m128 last_two = _mm_castpd_ps(_mm_loaddup_pd(reinterpret_cast<const double*>(faces + 4)));
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(faces)), last_two, 1);
  }
  static void store(void* to, Vector a) noexcept { _mm256_storeu_ps(static_cast<float*>(to), a); }
  static Vector first_in_all(Vector a) noexcept { return _mm256_broadcastss_ps(_mm256_castps256_ps128(a)); }
  static float first(Vector a) noexcept { return _mm256_cvtss_f32(a); }
  /// `even` in even lanes, `odd` in odd ones.
  static Vector pair_in_all(float even, float odd) noexcept {
    const __m128 pair = _mm_unpacklo_ps(_mm_set_ss(even), _mm_set_ss(odd));
    return _mm256_castpd_ps(_mm256_broadcastsd_pd(_mm_castps_pd(pair)));
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
  static Mask first_and_seventh(unsigned count) noexcept {
    return below(count, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, -1, 7));
  }
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
  static Vector permuted(Vector a, const std::uint32_t (&from)[8]) noexcept {
    return permuted(a, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
  }

  static Vector add(Vector a, Vector b) noexcept { return _mm256_add_ps(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return _mm256_sub_ps(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm256_mul_ps(a, b); }
  static Vector divide(Vector a, Vector b) noexcept { return _mm256_div_ps(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return _mm256_max_ps(a, b); }
  static Vector magnitude(Vector a) noexcept { return _mm256_andnot_ps(all(-0.0F), a); }
  static Vector minus_magnitude(Vector a) noexcept { return _mm256_or_ps(all(-0.0F), a); }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return _mm256_fmadd_ps(a, b, c); }
  /// a, negated in lanes 3 to 5.
  static Vector negate_hi(Vector a) noexcept {
    return _mm256_xor_ps(a, _mm256_setr_ps(0, 0, 0, -0.0F, -0.0F, -0.0F, 0, 0));
  }
  /// a, negated in lanes that are not in the mask.
  static Vector negate_unless(Mask mask, Vector a) noexcept {
    return _mm256_xor_ps(a, _mm256_andnot_ps(mask, all(-0.0F)));
  }
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
  struct Three {
    float of[3];
  };
  /// The largest lane of each.
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
  /// Whether no lo face of load_faces() is above the hi face on its axis, and none is NaN.
  static bool is_ordered(Vector faces) noexcept {
    const __m128i first_four = _mm_castps_si128(_mm256_castps256_ps128(faces));
    const __m128i last_four = _mm_castps_si128(_mm256_extractf128_ps(faces, 1));
    const __m128 hi = _mm_castsi128_ps(_mm_alignr_epi8(last_four, first_four, 3 * sizeof(float)));
    return (_mm_movemask_ps(_mm_cmple_ps(_mm_castsi128_ps(first_four), hi)) & 7) == 7;
  }

 private:
  static Mask below(unsigned count, __m256i lane) noexcept {
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane));
  }
};

}  // namespace shaftcull::kernel
#endif
