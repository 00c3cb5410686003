// SPDX-License-Identifier: MIT
#include <immintrin.h>

#include "peers/six_planes.hpp"
#include "support/compiler.hpp"

namespace shaftcull::bench {

void cull_by_six_planes_avx2(const SixPlanes& planes, const BoxView& boxes, std::uint64_t* kept) noexcept {
  constexpr unsigned width = 8;
  const float* x[6][3];
  for (unsigned p = 0; p < 6; ++p) {
    for (unsigned k = 0; k < 3; ++k) x[p][k] = boxes.stream[planes[p].normal[k] > 0 ? k : k + 3];
  }
  for (std::size_t w = 0; w < boxes.count / 64; ++w) {
    std::uint64_t outside = 0;
    for (unsigned four = 0; four < 64; four += 4 * width) {
      __m256 farthest[4];
      for (__m256& each : farthest) each = _mm256_set1_ps(-1);
      for (unsigned p = 0; p < 6; ++p) {
        const __m256 minus_offset = _mm256_set1_ps(-planes[p].offset);
        const __m256 normal[3] = {_mm256_set1_ps(planes[p].normal[0]), _mm256_set1_ps(planes[p].normal[1]),
                                  _mm256_set1_ps(planes[p].normal[2])};
        SHAFTCULL_UNROLL(4)
        for (unsigned v = 0; v < 4; ++v) {
          const std::size_t at = w * 64 + four + v * width;
          __m256 value = _mm256_fmadd_ps(_mm256_loadu_ps(x[p][0] + at), normal[0], minus_offset);
          value = _mm256_fmadd_ps(_mm256_loadu_ps(x[p][1] + at), normal[1], value);
          value = _mm256_fmadd_ps(_mm256_loadu_ps(x[p][2] + at), normal[2], value);
          farthest[v] = _mm256_max_ps(farthest[v], value);
        }
      }
      SHAFTCULL_UNROLL(4)
      for (unsigned v = 0; v < 4; ++v) {
        const __m256 is_beyond = _mm256_cmp_ps(farthest[v], _mm256_setzero_ps(), _CMP_GT_OQ);
        outside |= static_cast<std::uint64_t>(static_cast<unsigned>(_mm256_movemask_ps(is_beyond)))
                   << (four + v * width);
      }
    }
    kept[w] = ~outside;
  }
}

}  // namespace shaftcull::bench
