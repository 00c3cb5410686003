/// Writing what is not read again soon: in whole lines, past the caches.
#pragma once

#include <cstddef>
#include <cstring>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace shaftcull::kernel {

/// Copies floats to memory that is aligned to 64 bytes, from such memory. A line that is written through the caches
/// would first be read from memory. Other threads see what was written after finish_writing().
inline void write_past_caches(float* to, const float* from, std::size_t count) noexcept {
  std::size_t i = 0;
#if defined(__SSE__)
  for (; i + 16 <= count; i += 16) {
    for (std::size_t j = 0; j != 16; j += 4) _mm_stream_ps(to + i + j, _mm_load_ps(from + i + j));
  }
#endif
  std::memcpy(to + i, from + i, (count - i) * sizeof(float));
}

inline void finish_writing() noexcept {
#if defined(__SSE__)
  _mm_sfence();
#endif
}

}  // namespace shaftcull::kernel
