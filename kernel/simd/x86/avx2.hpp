// SPDX-License-Identifier: MIT
/// The set `avx2` (with FMA, BMI and BMI2): vectors of 8 floats and of 16 integers.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

// A name of its own for each set, so that none of xsimd's inline functions is shared with another one.
#define xsimd xsimd_avx2
#include "simd/operations.hpp"
#include "simd/x86/vectors_of_8.hpp"

namespace shaftcull::kernel::avx2 {

struct Set;
struct Integers16;

struct Floats : x86::FloatsOf<Set> {
  using Integers16 = avx2::Integers16;

  /// The bits of those in `mask`, side by side; and back.
  static std::uint64_t packed_bits(std::uint64_t bits, std::uint64_t mask) noexcept { return _pext_u64(bits, mask); }
  static std::uint64_t spread_bits(std::uint64_t bits, std::uint64_t mask) noexcept { return _pdep_u64(bits, mask); }
};

struct Integers16 : x86::XsimdIntegers16<Floats, xsimd::fma3<xsimd::avx2>> {
  static constexpr std::size_t fewest_shafts_on_grid = 5;
  static constexpr std::size_t fewest_tests_on_grid = 6144;

  // xsimd 8 has ssub(), but not without optimisation.
  static Vector subtract_saturated(Vector a, Vector b) noexcept { return _mm256_subs_epi16(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return _mm256_mulhrs_epi16(a, b); }

  /// What 32 bits do not hold becomes the least that they do, and packing saturates. Of 32 integers, the first vector
  /// has the first and third eight, so that outcomes() packs them in order.
  static void store_rounded(std::int16_t* out, const Floats::Vector (&of)[8], Vector least) noexcept {
    for (unsigned v = 0; v < 4; ++v) {
      const unsigned first = v / 2 * 4 + v % 2;
      const __m256i eights = _mm256_packs_epi32(_mm256_cvtps_epi32(of[first]), _mm256_cvtps_epi32(of[first + 2]));
      _mm256_store_si256(reinterpret_cast<__m256i*>(out) + v,
                         _mm256_max_epi16(_mm256_permute4x64_epi64(eights, 0xd8), least));
    }
  }

  /// Packed into bytes, which saturates and so keeps what matters, negative integers are above all others as unsigned
  /// ones.
  static Outcomes outcomes(const Vector (&of)[4], Vector limit) noexcept {
    const __m256i low = _mm256_packs_epi16(of[0], of[1]);
    const __m256i high = _mm256_packs_epi16(of[2], of[3]);
    const __m256i least = _mm256_min_epu8(low, high);
    const auto undecided =
        static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_min_epu8(least, limit), least)));
    return {static_cast<std::uint32_t>(_mm256_movemask_epi8(low)) |
                std::uint64_t{static_cast<std::uint32_t>(_mm256_movemask_epi8(high))} << 32,
            std::uint64_t{undecided} << 32 | undecided};
  }
};

static_assert(FloatOperations<Floats> && Integer16Operations<Integers16>);

}  // namespace shaftcull::kernel::avx2
