# SPDX-License-Identifier: MIT
# A baseline of AVX2, by the oldest compiler that is tried, with -O2. Kernels of SSE4.2 are left out.
needs(clang++-14)
configure(clang++-14 -D "PARENT_OPTIONS=-O2 -march=haswell" -D SHAFTCULL_WITH_TBB=OFF
  -D PARENT_MORE=${with_hashes})
build()
answers()
if(output MATCHES "sse4_2" OR NOT output MATCHES "avx2")
  message(FATAL_ERROR "kernels of SSE4.2 were not left out, or those of AVX2 were:\n${output}")
endif()
hashes_as_answered()
