// SPDX-License-Identifier: MIT
/// The operations that all sets of x86 share: those of xsimd, on vectors of any width.
///
/// A set's class derives from a template here and adds the operations that xsimd lacks or defines otherwise. The
/// template knows that class, so its functions are the set's own (kernel/kernels/README.md). The header of a set names
/// xsimd before it includes this.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#ifndef xsimd
#error "the header of an instruction set says what xsimd is called there"
#endif
#include <xsimd/xsimd.hpp>

namespace shaftcull::kernel::x86 {

/// FloatOperations by xsimd. Not minimum() and maximum(): where both are equal or either is NaN, xsimd's min() and
/// max() give the second before version 14, and the first from then on.
template <class Floats, class Architecture>
struct XsimdFloats {
  using Vector = xsimd::batch<float, Architecture>;
  using Mask = xsimd::batch_bool<float, Architecture>;
  static constexpr unsigned width = Vector::size;

  static Vector load(const float* p) noexcept { return Vector::load_unaligned(p); }
  static void store(float* p, Vector a) noexcept { a.store_unaligned(p); }

  static Vector all(float a) noexcept { return Vector(a); }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector square_root(Vector a) noexcept { return xsimd::sqrt(a); }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return xsimd::fma(a, b, c); }
  static Vector minimum_of_computed(Vector a, Vector b) noexcept { return Floats::minimum(a, b); }
  static Vector maximum_of_computed(Vector a, Vector b) noexcept { return Floats::maximum(a, b); }
  static Vector magnitude(Vector a) noexcept { return xsimd::abs(a); }
  static Vector floor(Vector a) noexcept { return xsimd::floor(a); }
  static Vector flip_sign(Vector a, Vector b) noexcept { return a ^ b; }
  static float smallest(Vector a) noexcept {
    return folded(a, [](__m128 x, __m128 y) { return _mm_min_ps(x, y); });
  }
  static float largest(Vector a) noexcept {
    return folded(a, [](__m128 x, __m128 y) { return _mm_max_ps(x, y); });
  }

  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Mask both(Mask a, Mask b) noexcept { return a & b; }
  static Mask either(Mask a, Mask b) noexcept { return a | b; }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return xsimd::select(mask, a, b); }
  static Vector either_negative(Vector a, Vector b) noexcept { return xsimd::select(b < Vector(0.0F), b, a); }

 private:
  /// All lanes put together by one(x, y). The set puts them together to four: folded_to_four(a, one).
  template <class One>
  static float folded(Vector a, One one) noexcept {
    const __m128 fours = Floats::folded_to_four(a, one);
    const __m128 pairs = one(fours, _mm_movehl_ps(fours, fours));
    return _mm_cvtss_f32(one(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }
};

/// The SignCollector of a set whose masks are vectors. Signs of four vectors are packed into one and read at once: each
/// vector read by itself would take a port of the arithmetic, and so would a comparison.
template <class Floats>
class PackedSignCollector {
 public:
  using Vector = typename Floats::Vector;

  explicit PackedSignCollector(Vector limit) noexcept : limit_(limit) {}

  std::uint64_t collect(const Vector (&of)[4]) noexcept {
    const Vector beyond[4] = {limit_ - of[0], limit_ - of[1], limit_ - of[2], limit_ - of[3]};
    const typename Floats::PackedSigns yes = Floats::packed(of);
    decided_ &= yes | Floats::packed(beyond);
    return Floats::signs(yes);
  }
  [[nodiscard]] bool any_undecided() const noexcept {
    return Floats::signs(decided_) != (std::uint64_t{1} << 4 * Floats::width) - 1;
  }

 private:
  Vector limit_;
  typename Floats::PackedSigns decided_ = ~typename Floats::PackedSigns{};
};

/// Integer16Operations by xsimd.
template <class FloatVectors, class Architecture>
struct XsimdIntegers16 {
  using Floats = FloatVectors;
  using Vector = xsimd::batch<std::int16_t, Architecture>;
  static constexpr unsigned width = Vector::size;
  static constexpr unsigned vectors = 64 / width;

  static Vector load(const std::int16_t* p) noexcept { return Vector::load_aligned(p); }
  static Vector all(std::int16_t a) noexcept { return Vector(a); }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector minimum(Vector a, Vector b) noexcept { return xsimd::min(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return xsimd::max(a, b); }
};

}  // namespace shaftcull::kernel::x86
