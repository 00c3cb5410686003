// SPDX-License-Identifier: MIT
/// Four floats, for what every processor does alike: reading the user's records, and sorting patches.
///
/// This is no instruction set to choose: it uses what every processor of the target has, which is SSE2 on x86-64 and
/// plain floats elsewhere. So it is the same whatever SHAFTCULL_ISA says, and nothing is asked of the processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "support/compiler.hpp"

#ifdef SHAFTCULL_TARGET_SSE2
#include <emmintrin.h>
#endif

namespace shaftcull::kernel {

#ifdef SHAFTCULL_TARGET_SSE2

class FourFloats {
 public:
  /// What holds of each of the four; at first everything does.
  class Truth {
   public:
    Truth() noexcept : mask_(_mm_castsi128_ps(_mm_set1_epi32(-1))) {}
    explicit Truth(__m128 mask) noexcept : mask_(mask) {}
    Truth& operator&=(Truth other) noexcept {
      mask_ = _mm_and_ps(mask_, other.mask_);
      return *this;
    }
    friend Truth operator&(Truth a, Truth b) noexcept { return a &= b; }
    [[nodiscard]] bool everywhere() const noexcept { return _mm_movemask_ps(mask_) == 15; }

   private:
    __m128 mask_;
  };

  FourFloats() noexcept : floats_(_mm_setzero_ps()) {}

  /// Three floats, which need not be aligned, and 0. Reads nothing else.
  static FourFloats three_at(const std::byte* floats) noexcept {
    double two;
    float one;
    std::memcpy(&two, floats, sizeof two);
    std::memcpy(&one, floats + sizeof two, sizeof one);
    return FourFloats(_mm_movelh_ps(_mm_castpd_ps(_mm_set_sd(two)), _mm_set_ss(one)));
  }
  static FourFloats of(float a, float b, float c, float d) noexcept { return FourFloats(_mm_setr_ps(a, b, c, d)); }
  static FourFloats all(float a) noexcept { return FourFloats(_mm_set1_ps(a)); }
  static FourFloats load(const float* from) noexcept { return FourFloats(_mm_loadu_ps(from)); }
  void store(float* to) const noexcept { _mm_storeu_ps(to, floats_); }
  /// Towards zero. Of floats whose integers fit.
  void store_integers(std::int32_t (&to)[4]) const noexcept {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_cvttps_epi32(floats_));
  }

  friend FourFloats operator+(FourFloats a, FourFloats b) noexcept {
    return FourFloats(_mm_add_ps(a.floats_, b.floats_));
  }
  friend FourFloats operator-(FourFloats a, FourFloats b) noexcept {
    return FourFloats(_mm_sub_ps(a.floats_, b.floats_));
  }
  friend FourFloats operator*(FourFloats a, FourFloats b) noexcept {
    return FourFloats(_mm_mul_ps(a.floats_, b.floats_));
  }
  /// a < b ? a : b, and a > b ? a : b: the second where either is NaN.
  friend FourFloats minimum(FourFloats a, FourFloats b) noexcept {
    return FourFloats(_mm_min_ps(a.floats_, b.floats_));
  }
  friend FourFloats maximum(FourFloats a, FourFloats b) noexcept {
    return FourFloats(_mm_max_ps(a.floats_, b.floats_));
  }
  /// Not where either is NaN.
  friend Truth operator<=(FourFloats a, FourFloats b) noexcept { return Truth(_mm_cmple_ps(a.floats_, b.floats_)); }

  /// Rows become columns.
  friend void transpose(FourFloats (&row)[4]) noexcept {
    _MM_TRANSPOSE4_PS(row[0].floats_, row[1].floats_, row[2].floats_, row[3].floats_);
  }

 private:
  explicit FourFloats(__m128 floats) noexcept : floats_(floats) {}
  __m128 floats_;
};

#else

class FourFloats {
 public:
  class Truth {
   public:
    Truth() noexcept = default;
    explicit Truth(bool holds) noexcept : holds_(holds) {}
    Truth& operator&=(Truth other) noexcept {
      holds_ &= other.holds_;
      return *this;
    }
    friend Truth operator&(Truth a, Truth b) noexcept { return a &= b; }
    [[nodiscard]] bool everywhere() const noexcept { return holds_; }

   private:
    bool holds_ = true;
  };

  static FourFloats three_at(const std::byte* floats) noexcept {
    FourFloats four;
    std::memcpy(four.floats_, floats, 3 * sizeof(float));
    return four;
  }
  static FourFloats of(float a, float b, float c, float d) noexcept {
    FourFloats four;
    four.floats_[0] = a;
    four.floats_[1] = b;
    four.floats_[2] = c;
    four.floats_[3] = d;
    return four;
  }
  static FourFloats all(float a) noexcept { return of(a, a, a, a); }
  static FourFloats load(const float* from) noexcept { return of(from[0], from[1], from[2], from[3]); }
  void store(float* to) const noexcept { std::memcpy(to, floats_, sizeof floats_); }
  void store_integers(std::int32_t (&to)[4]) const noexcept {
    for (std::size_t i = 0; i != 4; ++i) to[i] = static_cast<std::int32_t>(floats_[i]);
  }

  friend FourFloats operator+(FourFloats a, const FourFloats& b) noexcept {
    for (std::size_t i = 0; i != 4; ++i) a.floats_[i] += b.floats_[i];
    return a;
  }
  friend FourFloats operator-(FourFloats a, const FourFloats& b) noexcept {
    for (std::size_t i = 0; i != 4; ++i) a.floats_[i] -= b.floats_[i];
    return a;
  }
  friend FourFloats operator*(FourFloats a, const FourFloats& b) noexcept {
    for (std::size_t i = 0; i != 4; ++i) a.floats_[i] *= b.floats_[i];
    return a;
  }
  friend FourFloats minimum(FourFloats a, const FourFloats& b) noexcept {
    for (std::size_t i = 0; i != 4; ++i) a.floats_[i] = a.floats_[i] < b.floats_[i] ? a.floats_[i] : b.floats_[i];
    return a;
  }
  friend FourFloats maximum(FourFloats a, const FourFloats& b) noexcept {
    for (std::size_t i = 0; i != 4; ++i) a.floats_[i] = a.floats_[i] > b.floats_[i] ? a.floats_[i] : b.floats_[i];
    return a;
  }
  friend Truth operator<=(const FourFloats& a, const FourFloats& b) noexcept {
    bool holds = true;
    for (std::size_t i = 0; i != 4; ++i) holds &= a.floats_[i] <= b.floats_[i];
    return Truth(holds);
  }
  friend void transpose(FourFloats (&row)[4]) noexcept {
    for (std::size_t i = 0; i != 4; ++i) {
      for (std::size_t k = 0; k != i; ++k) {
        const float other = row[i].floats_[k];
        row[i].floats_[k] = row[k].floats_[i];
        row[k].floats_[i] = other;
      }
    }
  }

 private:
  float floats_[4] = {0, 0, 0, 0};
};

#endif

}  // namespace shaftcull::kernel
