/// Vectors of floats, as the kernels see them: `Lanes<Arch>` over xsimd, for every instruction set alike.
///
/// Only what kernels need, and with semantics pinned down: minimum(a, b) and maximum(a, b) give b if either is
/// NaN, so that a NaN coordinate in `a` is ignored. Functions are templates on an architecture that only one
/// translation unit uses; see kernel/test/README.md for why.
#pragma once

#include <immintrin.h>

#include <cstdint>
#include <xsimd/xsimd.hpp>

namespace shaftcull::kernel {

template <class Arch>
struct Lanes {
  using Vector = xsimd::batch<float, Arch>;
  using Mask = xsimd::batch_bool<float, Arch>;
  static constexpr unsigned width = sizeof(Vector) / sizeof(float);

  static Vector load(const float* p) noexcept { return Vector::load_unaligned(p); }
  static void store(float* p, Vector a) noexcept { a.store_unaligned(p); }
  static Vector all(float a) noexcept { return Vector(a); }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector minimum(Vector a, Vector b) noexcept { return xsimd::min(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return xsimd::max(a, b); }
  static Vector magnitude(Vector a) noexcept { return xsimd::abs(a); }
  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Mask both(Mask a, Mask b) noexcept { return a & b; }
  static Mask either(Mask a, Mask b) noexcept { return a | b; }

  /// a · b + c, rounded once where the instruction set can and twice where it cannot: margins allow for both.
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept {
#ifdef __AVX512F__
    if constexpr (width == 16) return _mm512_fmadd_ps(a, b, c);  // xsimd 8 multiplies and adds there
    else
#endif
      return xsimd::fma(a, b, c);
  }

  /// Bit i is lane i.
  static std::uint64_t bits(Mask mask) noexcept {
    if constexpr (requires { mask.mask(); }) {
      return mask.mask();
    } else {  // xsimd 8 has no mask()
#ifdef __AVX512F__
      if constexpr (width == 16) return static_cast<__mmask16>(mask);
#endif
#ifdef __AVX__
      if constexpr (width == 8) return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
#endif
      if constexpr (width == 4) return static_cast<std::uint32_t>(_mm_movemask_ps(mask));
    }
  }
};

}  // namespace shaftcull::kernel
