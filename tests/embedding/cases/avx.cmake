# SPDX-License-Identifier: MIT
# AVX without AVX2: less than the instruction set AVX2 needs, more than that of SSE4.2, which stays.
needs(g++)
configure(g++ -D "PARENT_OPTIONS=-O0 -mavx" -D SHAFTCULL_WITH_TBB=OFF)
build()
answers()
if(NOT output MATCHES "sse4_2")
  message(FATAL_ERROR "kernels of SSE4.2 were left out:\n${output}")
endif()
