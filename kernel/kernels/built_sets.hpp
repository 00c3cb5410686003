/// The one place that knows which instruction sets this build has kernels for.
#pragma once

#include "kernels/table.hpp"
#include "simd/baseline.hpp"

namespace shaftcull::kernel {

extern const Kernels scalar_kernels;
extern const Kernels sse4_2_kernels;
extern const Kernels avx2_kernels;
extern const Kernels avx512_kernels;

/// The kernels built for `isa`, or null.
inline const Kernels* kernels_of(Isa isa) noexcept {
  switch (isa) {
    case Isa::scalar:
      return &scalar_kernels;
#if defined(SHAFTCULL_HAVE_SSE4_2) && !defined(SHAFTCULL_COMPILED_FOR_AVX2)
    case Isa::sse4_2:
      return &sse4_2_kernels;
#endif
#if defined(SHAFTCULL_HAVE_AVX2) && !defined(SHAFTCULL_COMPILED_FOR_AVX512)
    case Isa::avx2:
      return &avx2_kernels;
#endif
#ifdef SHAFTCULL_HAVE_AVX512
    case Isa::avx512:
      return &avx512_kernels;
#endif
    default:
      return nullptr;
  }
}

}  // namespace shaftcull::kernel
