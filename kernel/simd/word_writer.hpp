// SPDX-License-Identifier: MIT
/// Writing words of streams: much at once goes to memory in whole lines, past the caches.
#pragma once

#include <cstddef>
#include <cstring>

#include "support/compiler.hpp"

#ifdef SHAFTCULL_TARGET_SSE2
#include <xmmintrin.h>
#endif

namespace shaftcull::kernel {

/// Copies floats from and to memory that is aligned to 16 bytes, and for speed to 64.
///
/// A line that is written through the caches is read from memory first, and drives out another one; but then it is at
/// hand. Other threads see what was written past the caches when the writer is gone.
class WordWriter {
 public:
  /// `bytes` are all that is written, by all writers together: what a cache holds is written through it.
  explicit WordWriter(std::size_t bytes) noexcept : past_caches_(bytes > cached_bytes) {}
  WordWriter(const WordWriter&) = delete;
  WordWriter& operator=(const WordWriter&) = delete;
  ~WordWriter() {
#ifdef SHAFTCULL_TARGET_SSE2
    if (past_caches_) _mm_sfence();
#endif
  }

  void write(float* to, const float* from, std::size_t count) const noexcept {
    std::size_t i = 0;
#ifdef SHAFTCULL_TARGET_SSE2
    if (past_caches_) {
      for (; i + 16 <= count; i += 16) {
        for (std::size_t j = 0; j != 16; j += 4) _mm_stream_ps(to + i + j, _mm_load_ps(from + i + j));
      }
    }
#endif
    std::memcpy(to + i, from + i, (count - i) * sizeof(float));
  }

 private:
  static constexpr std::size_t cached_bytes = std::size_t{16} << 20;

  [[maybe_unused]] bool past_caches_;  // on x86
};

}  // namespace shaftcull::kernel
