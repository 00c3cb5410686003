/// The first lanes of a vector: how the bounds of a view that do not fill a vector are read where they are.
///
/// Nothing past those lanes is read, so a view may end just before memory that cannot be. As in lanes.hpp, classes are
/// templates on an architecture that only one translation unit uses.
#pragma once

#include <immintrin.h>

namespace shaftcull::kernel {

/// The first `count` lanes of `width`: none if count ≤ 0, all if count ≥ width.
template <class Arch, unsigned width>
class Part;

template <class Arch>
class Part<Arch, 4> {
 public:
  explicit Part(int count) noexcept : count_(count) {}

  /// p[i] in these lanes, and 0 in the others.
  [[nodiscard]] __m128 load(const float* p) const noexcept {
    if (count_ >= 4) return _mm_loadu_ps(p);
    if (count_ <= 0) return _mm_setzero_ps();
    if (count_ == 1) return _mm_load_ss(p);
    const __m128 two = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
    return count_ == 2 ? two : _mm_movelh_ps(two, _mm_load_ss(p + 2));
  }
  /// a in these lanes, and b in the others.
  [[nodiscard]] __m128 choose(__m128 a, __m128 b) const noexcept {
    const __m128i mask = _mm_cmpgt_epi32(_mm_set1_epi32(count_), _mm_setr_epi32(0, 1, 2, 3));
    return _mm_blendv_ps(b, a, _mm_castsi128_ps(mask));
  }

 private:
  int count_;
};

#ifdef SHAFTCULL_UNIT_AVX2
template <class Arch>
class Part<Arch, 8> {
 public:
  explicit Part(int count) noexcept
      : mask_(_mm256_cmpgt_epi32(_mm256_set1_epi32(count), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7))) {}

  [[nodiscard]] __m256 load(const float* p) const noexcept { return _mm256_maskload_ps(p, mask_); }
  [[nodiscard]] __m256 choose(__m256 a, __m256 b) const noexcept {
    return _mm256_blendv_ps(b, a, _mm256_castsi256_ps(mask_));
  }

 private:
  __m256i mask_;
};
#endif

#ifdef SHAFTCULL_UNIT_AVX512
template <class Arch>
class Part<Arch, 16> {
 public:
  explicit Part(int count) noexcept
      : mask_(static_cast<__mmask16>(count <= 0    ? 0U
                                     : count >= 16 ? 0xffffU
                                                   : (1U << count) - 1)) {}

  [[nodiscard]] __m512 load(const float* p) const noexcept { return _mm512_maskz_loadu_ps(mask_, p); }
  [[nodiscard]] __m512 choose(__m512 a, __m512 b) const noexcept { return _mm512_mask_mov_ps(b, mask_, a); }

 private:
  __mmask16 mask_;
};
#endif

}  // namespace shaftcull::kernel
