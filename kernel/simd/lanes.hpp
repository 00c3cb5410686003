/// Vectors of floats, as the kernels see them: `Lanes<Arch>` over xsimd, for every instruction set alike.
///
/// Only what kernels need, and with semantics pinned down: minimum(a, b) and maximum(a, b) give b if either is
/// NaN, so that a NaN coordinate in `a` is ignored. Functions are templates on an architecture that only one
/// translation unit uses; see kernel/kernels/README.md for why.
///
/// SHAFTCULL_UNIT_AVX2 and, besides, SHAFTCULL_UNIT_AVX512 say whose unit this is. What the compiler may use (__AVX2__)
/// says something else: with -march=native it may use AVX-512 in the units of all instruction sets.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "simd/eight.hpp"
#include "simd/left_packing.hpp"
#include "simd/part.hpp"

namespace shaftcull::kernel {

template <class Arch>
struct Shorts;

template <class Arch>
struct Lanes {
  using Shorts = kernel::Shorts<Arch>;
#ifdef SHAFTCULL_UNIT_AVX2
  using Eight = kernel::Eight<Arch>;
#endif
  using Vector = xsimd::batch<float, Arch>;
  using Mask = xsimd::batch_bool<float, Arch>;
  static constexpr unsigned width = sizeof(Vector) / sizeof(float);
  using Part = kernel::Part<Arch, width>;

  static Vector load(const float* p) noexcept { return Vector::load_unaligned(p); }
  /// p[index[i]] in lane i.
  static Vector gather(const float* p, const std::uint16_t* index) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16) {
      const __m256i sixteen = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
      return _mm512_i32gather_ps(_mm512_cvtepu16_epi32(sixteen), p, sizeof(float));
    }
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 8) {
      const __m128i eight = _mm_loadu_si128(reinterpret_cast<const __m128i*>(index));
      return _mm256_i32gather_ps(p, _mm256_cvtepu16_epi32(eight), sizeof(float));
    }
#endif
    if constexpr (width == 4) return _mm_setr_ps(p[index[0]], p[index[1]], p[index[2]], p[index[3]]);
  }
  /// Four floats at each of `at`: columns[c] has float c of at[i] in lane i.
  static void load_fours(const float* const (&at)[width], Vector (&columns)[4]) noexcept {
    if constexpr (width == 4) {
      __m128 row[4];
      for (unsigned i = 0; i < 4; ++i) row[i] = _mm_loadu_ps(at[i]);
      _MM_TRANSPOSE4_PS(row[0], row[1], row[2], row[3]);
      for (unsigned c = 0; c < 4; ++c) columns[c] = row[c];
      return;
    }
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 8) {
      __m256 row[4];  // i, and i + 4 in the upper half
      for (unsigned i = 0; i < 4; ++i) {
        row[i] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at[i])), _mm_loadu_ps(at[i + 4]), 1);
      }
      const __m256 first[2] = {_mm256_unpacklo_ps(row[0], row[1]), _mm256_unpacklo_ps(row[2], row[3])};
      const __m256 last[2] = {_mm256_unpackhi_ps(row[0], row[1]), _mm256_unpackhi_ps(row[2], row[3])};
      columns[0] = _mm256_shuffle_ps(first[0], first[1], 0x44);
      columns[1] = _mm256_shuffle_ps(first[0], first[1], 0xee);
      columns[2] = _mm256_shuffle_ps(last[0], last[1], 0x44);
      columns[3] = _mm256_shuffle_ps(last[0], last[1], 0xee);
      return;
    }
#endif
    static_assert(width <= 8, "formation runs on vectors of at most eight");
  }
  static void store(float* p, Vector a) noexcept { a.store_unaligned(p); }

  /// Puts the lanes whose bits are set side by side.
  class Packing {
   public:
    explicit Packing(std::uint64_t lanes) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
      if constexpr (width == 16) {
        const __m512i all = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        from_ = _mm512_maskz_compress_epi32(static_cast<__mmask16>(lanes), all);
      }
#endif
#ifdef SHAFTCULL_UNIT_AVX2
      if constexpr (width == 8) {
        from_ = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(left_packing<8, 1>.part[lanes])));
      }
#endif
      if constexpr (width == 4)
        from_ = _mm_load_si128(reinterpret_cast<const __m128i*>(left_packing<4, 4>.part[lanes]));
    }

    /// Stores them, and anything in the rest of a whole vector.
    void store(float* p, Vector a) const noexcept { Lanes::store(p, packed(a)); }

    /// Stores the first `count` of them, which is less than a whole vector, and nothing else.
    void store(float* p, Vector a, std::size_t count) const noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
      if constexpr (width == 16) return _mm512_mask_storeu_ps(p, static_cast<__mmask16>((1U << count) - 1), packed(a));
#endif
#ifdef SHAFTCULL_UNIT_AVX2
      if constexpr (width == 8) {
        const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        return _mm256_maskstore_ps(p, _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), lane), packed(a));
      }
#endif
      if constexpr (width == 4) {
        float lane[4];
        Lanes::store(lane, packed(a));
        for (std::size_t i = 0; i < count; ++i) p[i] = lane[i];
      }
    }

   private:
    [[nodiscard]] Vector packed(Vector a) const noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
      if constexpr (width == 16) return _mm512_permutexvar_ps(from_, a);
#endif
#ifdef SHAFTCULL_UNIT_AVX2
      if constexpr (width == 8) return _mm256_permutevar8x32_ps(a, from_);
#endif
      if constexpr (width == 4) return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(a), from_));
    }

    xsimd::batch<std::int32_t, Arch> from_;
  };

  static Vector all(float a) noexcept { return Vector(a); }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector square_root(Vector a) noexcept { return xsimd::sqrt(a); }
  // Not by xsimd, whose min() and max() give the first of two equal values or if either is NaN from version 14 on, and
  // before that the second.
  static Vector minimum(Vector a, Vector b) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16) return _mm512_min_ps(a, b);
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 8) return _mm256_min_ps(a, b);
#endif
    if constexpr (width == 4) return _mm_min_ps(a, b);
  }
  static Vector maximum(Vector a, Vector b) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16) return _mm512_max_ps(a, b);
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 8) return _mm256_max_ps(a, b);
#endif
    if constexpr (width == 4) return _mm_max_ps(a, b);
  }
  static Vector magnitude(Vector a) noexcept { return xsimd::abs(a); }
  static Vector floor(Vector a) noexcept { return xsimd::floor(a); }
  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return xsimd::select(mask, a, b); }
  static Mask both(Mask a, Mask b) noexcept { return a & b; }
  static Mask either(Mask a, Mask b) noexcept { return a | b; }

  /// a · b + c, rounded once where the instruction set can and twice where it cannot: margins allow for both.
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16)
      return _mm512_fmadd_ps(a, b, c);  // xsimd 8 multiplies and adds there
    else
#endif
      return xsimd::fma(a, b, c);
  }

#ifdef SHAFTCULL_UNIT_AVX2
  using Row = __m256;
#else
  struct Row {
    float of[8];
  };
#endif

  /// Lane i of the eight vectors becomes row i.
  static void transpose(const Vector (&columns)[8], Row (&rows)[width]) noexcept {
#ifdef SHAFTCULL_UNIT_AVX2
    for (unsigned lane = 0; lane < width; lane += 8) {  // 8 × 8, in pairs, then fours, then halves
      __m256 pair[8];
      for (unsigned c = 0; c < 8; c += 2) {
        pair[c] = _mm256_unpacklo_ps(eight_of(columns[c], lane), eight_of(columns[c + 1], lane));
        pair[c + 1] = _mm256_unpackhi_ps(eight_of(columns[c], lane), eight_of(columns[c + 1], lane));
      }
      __m256 four[8];
      for (unsigned i = 0; i < 8; i += 4) {
        four[i] = _mm256_shuffle_ps(pair[i], pair[i + 2], 0x44);
        four[i + 1] = _mm256_shuffle_ps(pair[i], pair[i + 2], 0xee);
        four[i + 2] = _mm256_shuffle_ps(pair[i + 1], pair[i + 3], 0x44);
        four[i + 3] = _mm256_shuffle_ps(pair[i + 1], pair[i + 3], 0xee);
      }
      for (unsigned i = 0; i < 4; ++i) {
        rows[lane + i] = _mm256_permute2f128_ps(four[i], four[i + 4], 0x20);
        rows[lane + i + 4] = _mm256_permute2f128_ps(four[i], four[i + 4], 0x31);
      }
    }
#else
    float column[8][width];
    for (unsigned c = 0; c < 8; ++c) store(column[c], columns[c]);
    for (unsigned lane = 0; lane < width; ++lane) {
      for (unsigned c = 0; c < 8; ++c) rows[lane].of[c] = column[c][lane];
    }
#endif
  }

  /// Float i is row[order[i]].
  static Row permuted(const Row& row, const std::uint32_t (&order)[8]) noexcept {
#ifdef SHAFTCULL_UNIT_AVX2
    return _mm256_permutevar8x32_ps(row, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(order)));
#else
    Row permuted;
    for (unsigned i = 0; i < 8; ++i) permuted.of[i] = row.of[order[i]];
    return permuted;
#endif
  }

  static void store_row(const Row& row, void* out) noexcept {
#ifdef SHAFTCULL_UNIT_AVX2
    _mm256_storeu_ps(static_cast<float*>(out), row);
#else
    __builtin_memcpy(out, row.of, sizeof row.of);
#endif
  }

  /// Bit i is the sign of row[i].
  static unsigned row_signs(const Row& row) noexcept {
#ifdef SHAFTCULL_UNIT_AVX2
    return static_cast<unsigned>(_mm256_movemask_ps(row));
#else
    return static_cast<unsigned>(_mm_movemask_ps(_mm_loadu_ps(row.of)) | _mm_movemask_ps(_mm_loadu_ps(row.of + 4))
                                                                             << 4);
#endif
  }

  /// a, negated where the sign of b is set; b is ±0.
  static Vector flip_sign(Vector a, Vector b) noexcept { return a ^ b; }

  /// A vector of which only signs matter: negative where a or b is below 0. b may be −0 or NaN, whose sign says
  /// nothing.
  static Vector either_negative(Vector a, Vector b) noexcept { return xsimd::select(b < Vector(0.0F), b, a); }

 private:
  /// The signs of four vectors, as those of bytes; on AVX2 and AVX-512 in another order.
  using Packed = xsimd::batch<std::int32_t, Arch>;
  static Packed packed(const Vector (&of)[4]) noexcept {  // packing saturates, which keeps signs
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16) {
      return _mm512_packs_epi16(_mm512_packs_epi32(_mm512_castps_si512(of[0]), _mm512_castps_si512(of[1])),
                                _mm512_packs_epi32(_mm512_castps_si512(of[2]), _mm512_castps_si512(of[3])));
    }
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 8) {
      return _mm256_packs_epi16(_mm256_packs_epi32(_mm256_castps_si256(of[0]), _mm256_castps_si256(of[1])),
                                _mm256_packs_epi32(_mm256_castps_si256(of[2]), _mm256_castps_si256(of[3])));
    }
#endif
    if constexpr (width == 4) {
      return _mm_packs_epi16(_mm_packs_epi32(_mm_castps_si128(of[0]), _mm_castps_si128(of[1])),
                             _mm_packs_epi32(_mm_castps_si128(of[2]), _mm_castps_si128(of[3])));
    }
  }
  static std::uint64_t signs(
      Packed bytes) noexcept {  // packing works on quarters: fours of lanes 0–3 come before fours of lanes 4–7
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16) {
      const __m512i order = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
      return _mm512_movepi8_mask(_mm512_permutexvar_epi32(order, bytes));
    }
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 8) {
      const __m256i order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
      return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permutevar8x32_epi32(bytes, order)));
    }
#endif
    if constexpr (width == 4) return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes));
  }

 public:
  /// Bit i is the sign of lane i of four vectors side by side.
  static std::uint64_t signs(const Vector (&of)[4]) noexcept { return signs(packed(of)); }

  /// Reads outcomes from signs: a negative float is a yes, one above the limit a no, and one in between undecided.
  ///
  /// Signs of four vectors are packed into one and read at once: each vector read by itself would take a port of the
  /// arithmetic, and so would a comparison. On AVX-512 alone comparisons make masks, which are quicker combined than
  /// packed.
  class Verdicts {
   public:
    explicit Verdicts(Vector limit) noexcept : limit_(limit) {}

    /// Bit i is the verdict of lane i of four vectors side by side.
    std::uint64_t read(const Vector (&of)[4]) noexcept {
      if constexpr (width == 16) {
#ifdef SHAFTCULL_UNIT_AVX512
        for (unsigned v = 0; v < 4; ++v) {  // as unsigned integers, negative floats are above all others
          undecided_ |= _mm512_cmple_epu32_mask(_mm512_castps_si512(of[v]), _mm512_castps_si512(limit_));
        }
        return signs(of);
#endif
      } else {
        const Vector beyond[4] = {limit_ - of[0], limit_ - of[1], limit_ - of[2], limit_ - of[3]};
        const Packed yes = packed(of);
        decided_ = decided_ & (yes | packed(beyond));
        return signs(yes);
      }
    }

    [[nodiscard]] bool any_undecided() const noexcept {
      if constexpr (width == 16) {
        return undecided_ != 0;
      } else {
        return signs(decided_) != (std::uint64_t{1} << 4 * width) - 1;
      }
    }

   private:
    Vector limit_;
    std::uint32_t undecided_ = 0;
    Packed decided_ = Packed(-1);
  };

  /// The larger of the bit patterns, as unsigned integers.
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16) {
      return _mm512_castsi512_ps(_mm512_max_epu32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
    }
#endif
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width == 8) {
      return _mm256_castsi256_ps(_mm256_max_epu32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
    }
#endif
    if constexpr (width == 4) {
      return _mm_castsi128_ps(_mm_max_epu32(_mm_castps_si128(a), _mm_castps_si128(b)));
    }
  }

  /// Bit i is lane i.
  static std::uint64_t bits(Mask mask) noexcept {
    if constexpr (requires { mask.mask(); }) {
      return mask.mask();
    } else {  // xsimd 8 has no mask()
#ifdef SHAFTCULL_UNIT_AVX512
      if constexpr (width == 16) return static_cast<__mmask16>(mask);
#endif
#ifdef SHAFTCULL_UNIT_AVX2
      if constexpr (width == 8) return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
#endif
      if constexpr (width == 4) return static_cast<std::uint32_t>(_mm_movemask_ps(mask));
    }
  }

  /// The smallest and the largest lane. NaN must not occur.
  static float smallest(Vector a) noexcept {
    return folded(a, [](__m128 x, __m128 y) { return _mm_min_ps(x, y); });
  }
  static float largest(Vector a) noexcept {
    return folded(a, [](__m128 x, __m128 y) { return _mm_max_ps(x, y); });
  }

 private:
  /// All lanes put together by one(x, y), lane by lane of four.
  template <class One>
  static float folded(Vector a, One one) noexcept {
    __m128 four;
#ifdef SHAFTCULL_UNIT_AVX2
    if constexpr (width != 4) {
      const __m256 low = eight_of(a, 0);
      four = one(_mm256_castps256_ps128(low), _mm256_extractf128_ps(low, 1));
      if constexpr (width == 16) {
        const __m256 high = eight_of(a, 8);
        four = one(four, one(_mm256_castps256_ps128(high), _mm256_extractf128_ps(high, 1)));
      }
    } else
#endif
      four = a;
    four = one(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(one(four, _mm_shuffle_ps(four, four, 1)));
  }
#ifdef SHAFTCULL_UNIT_AVX2
  /// Lanes [lane, lane + 8).
  static __m256 eight_of(Vector a, [[maybe_unused]] unsigned lane) noexcept {
#ifdef SHAFTCULL_UNIT_AVX512
    if constexpr (width == 16)
      return lane == 0 ? _mm512_castps512_ps256(a) : _mm512_extractf32x8_ps(a, 1);
    else
#endif
      return a;
  }
#endif
};

}  // namespace shaftcull::kernel
