# SPDX-License-Identifier: MIT
# 32-bit x86 with SSE2, which has portable kernels only.
needs(g++ -m32)
configure(g++ -D "CMAKE_CXX_FLAGS=-m32 -msse2 -mfpmath=sse -O0" -D SHAFTCULL_WITH_TBB=OFF -D SHAFTCULL_BUILD_C=ON
  -D CMAKE_DISABLE_FIND_PACKAGE_xsimd=ON)
build()
answers("scalar: as on record\nportable128: as on record\n")
