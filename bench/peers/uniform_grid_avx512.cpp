// SPDX-License-Identifier: MIT
#include <immintrin.h>

#include <bit>

#include "peers/uniform_grid_sweep.hpp"

namespace shaftcull::bench {
namespace {

struct Avx512 {
  using Vector = __m512;
  static constexpr unsigned width = 16;
  static Vector all(float x) noexcept { return _mm512_set1_ps(x); }
  static Vector load(const float* p) noexcept { return _mm512_loadu_ps(p); }
  static Vector multiply_add(Vector x, Vector y, Vector z) noexcept { return _mm512_fmadd_ps(x, y, z); }
  static Vector add(Vector x, Vector y) noexcept { return _mm512_add_ps(x, y); }
  static Vector subtract(Vector x, Vector y) noexcept { return _mm512_sub_ps(x, y); }
  static Vector minimum(Vector x, Vector y) noexcept { return _mm512_min_ps(x, y); }
  static Vector maximum(Vector x, Vector y) noexcept { return _mm512_max_ps(x, y); }
  static unsigned less_equal(Vector x, Vector y) noexcept { return _mm512_cmp_ps_mask(x, y, _CMP_LE_OQ); }
  static unsigned write(const std::uint32_t* indices, unsigned bits, std::uint32_t* out) noexcept {
    const __m512i all = _mm512_loadu_si512(indices);
    // Compressed in a register: Zen 4 takes a hundred cycles to do so in memory.
    _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), all));
    return static_cast<unsigned>(std::popcount(bits));
  }
};

}  // namespace

extern SweepGrid* const avx512_sweep_grid;
SweepGrid* const avx512_sweep_grid = sweep<Avx512>;

}  // namespace shaftcull::bench
