/// Vectors of 16-bit integers, twice as wide as those of floats: what tests on a grid compute with.
///
/// As in lanes.hpp, functions are templates on an architecture that only one translation unit uses.
#pragma once

#include <cstdint>

#include "simd/lanes.hpp"

namespace shaftcull::kernel {

/// Words of 64 shorts. The order of a word's shorts in memory is the instruction set's own: store_word() and outcomes()
/// know it.
template <class Arch>
struct Shorts {
  using Floats = Lanes<Arch>;
  using Vector = xsimd::batch<std::int16_t, Arch>;
  static constexpr unsigned width = 2 * Floats::width;
  static constexpr unsigned vectors = 64 / width;  // in a word

  static Vector load(const std::int16_t* p) noexcept { return Vector::load_aligned(p); }
  static Vector all(std::int16_t a) noexcept { return Vector(a); }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector minimum(Vector a, Vector b) noexcept { return xsimd::min(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return xsimd::max(a, b); }

  /// a − b, or the nearest to it of what there is. (xsimd 8 has ssub(), but not without optimisation.)
  static Vector subtract_saturated(Vector a, Vector b) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 32) return _mm512_subs_epi16(a, b);
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 16) return _mm256_subs_epi16(a, b);
#endif
    if constexpr (width == 8) return _mm_subs_epi16(a, b);
  }

  /// a · b / 2¹⁵, rounded to nearest. Not for −2¹⁵ times itself.
  static Vector multiply(Vector a, Vector b) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 32) return _mm512_mulhrs_epi16(a, b);
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 16) return _mm256_mulhrs_epi16(a, b);
#endif
    if constexpr (width == 8) return _mm_mulhrs_epi16(a, b);
  }

  /// Stores the nearest integers of a word of floats, none of which is above the range of shorts: `least` for those
  /// that are below it, or NaN.
  static void store_word(std::int16_t* out, const typename Floats::Vector (&of)[64 / Floats::width],
                         Vector least) noexcept {
    // What 32 bits do not hold becomes the least that they do, and packing saturates.
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 32) {
      for (unsigned v = 0; v < 4; ++v) {
        const __m256i sixteen = _mm512_cvtsepi32_epi16(_mm512_cvtps_epi32(of[v]));
        _mm256_store_si256(reinterpret_cast<__m256i*>(out) + v,
                           _mm256_max_epi16(sixteen, _mm512_castsi512_si256(least)));
      }
    }
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 16) {  // of 32, the first vector has the first and third eight, so that outcomes() packs
                                  // them in order
      for (unsigned v = 0; v < 4; ++v) {
        const unsigned first = v / 2 * 4 + v % 2;
        const __m256i eights = _mm256_packs_epi32(_mm256_cvtps_epi32(of[first]), _mm256_cvtps_epi32(of[first + 2]));
        _mm256_store_si256(reinterpret_cast<__m256i*>(out) + v,
                           _mm256_max_epi16(_mm256_permute4x64_epi64(eights, 0xd8), least));
      }
    }
#endif
    if constexpr (width == 8) {
      for (unsigned v = 0; v < 8; ++v) {
        const __m128i eight = _mm_packs_epi32(_mm_cvtps_epi32(of[2 * v]), _mm_cvtps_epi32(of[2 * v + 1]));
        _mm_store_si128(reinterpret_cast<__m128i*>(out) + v, _mm_max_epi16(eight, least));
      }
    }
  }

  /// What a word of integers says: a negative one is a yes, one above a limit a no, and one in between undecided.
  struct Outcomes {
    std::uint64_t yes;
    std::uint64_t undecided;  // these lanes, and maybe others
  };

  /// `limit` is at most 126, in every byte.
  static Outcomes outcomes(const Vector (&of)[vectors], Vector limit) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 32) {
      const __m512i wide = _mm512_srli_epi16(limit, 8);
      return {_mm512_movepi16_mask(of[0]) | std::uint64_t{_mm512_movepi16_mask(of[1])} << 32,
              _mm512_cmple_epu16_mask(of[0], wide) | std::uint64_t{_mm512_cmple_epu16_mask(of[1], wide)} << 32};
    }
#endif
    // Packed into bytes, which saturates and so keeps what matters, negative ones are above all others as unsigned
    // integers.
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 16) {
      const __m256i low = _mm256_packs_epi16(of[0], of[1]);
      const __m256i high = _mm256_packs_epi16(of[2], of[3]);
      const __m256i least = _mm256_min_epu8(low, high);
      const auto undecided =
          static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_min_epu8(least, limit), least)));
      return {static_cast<std::uint32_t>(_mm256_movemask_epi8(low)) |
                  std::uint64_t{static_cast<std::uint32_t>(_mm256_movemask_epi8(high))} << 32,
              std::uint64_t{undecided} << 32 | undecided};
    }
#endif
    if constexpr (width == 8) {
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
  }
};

}  // namespace shaftcull::kernel
