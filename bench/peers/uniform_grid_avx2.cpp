// SPDX-License-Identifier: MIT
#include <immintrin.h>

#include <array>
#include <bit>

#include "peers/uniform_grid_sweep.hpp"

namespace shaftcull::bench {
namespace {

/// For every set of eight lanes, which lanes come first, a byte each.
constexpr auto lanes_first = [] {
  std::array<std::uint64_t, 256> lanes{};
  for (unsigned set = 0; set < 256; ++set) {
    unsigned to = 0;
    for (unsigned lane = 0; lane < 8; ++lane) {
      if (set >> lane & 1U) lanes[set] |= std::uint64_t{lane} << 8 * to++;
    }
  }
  return lanes;
}();

struct Avx2 {
  using Vector = __m256;
  static constexpr unsigned width = 8;
  static Vector all(float x) noexcept { return _mm256_set1_ps(x); }
  static Vector load(const float* p) noexcept { return _mm256_loadu_ps(p); }
  static Vector multiply_add(Vector x, Vector y, Vector z) noexcept { return _mm256_fmadd_ps(x, y, z); }
  static Vector add(Vector x, Vector y) noexcept { return _mm256_add_ps(x, y); }
  static Vector subtract(Vector x, Vector y) noexcept { return _mm256_sub_ps(x, y); }
  static Vector minimum(Vector x, Vector y) noexcept { return _mm256_min_ps(x, y); }
  static Vector maximum(Vector x, Vector y) noexcept { return _mm256_max_ps(x, y); }
  static unsigned less_equal(Vector x, Vector y) noexcept {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(x, y, _CMP_LE_OQ)));
  }
  static unsigned write(const std::uint32_t* indices, unsigned bits, std::uint32_t* out) noexcept {
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(indices));
    const __m256i lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(lanes_first[bits])));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_permutevar8x32_epi32(all, lanes));
    return static_cast<unsigned>(std::popcount(bits));
  }
};

}  // namespace

extern SweepGrid* const avx2_sweep_grid;
SweepGrid* const avx2_sweep_grid = sweep<Avx2>;

}  // namespace shaftcull::bench
