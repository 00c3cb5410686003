# SPDX-License-Identifier: MIT
# 32-bit x86 with SSE2, which has portable kernels only. Headers of the kernel are those of 64 bits, which say of each what it has.
execute_process(COMMAND g++ -print-multiarch OUTPUT_VARIABLE system OUTPUT_STRIP_TRAILING_WHITESPACE)
set(bits_32 -m32 -msse2 -mfpmath=sse -idirafter /usr/include/${system})
needs(g++ ${bits_32})
list(JOIN bits_32 " " flags)
configure(g++ -D "CMAKE_CXX_FLAGS=${flags} -O0" -D SHAFTCULL_WITH_TBB=OFF -D SHAFTCULL_BUILD_C=ON
  -D CMAKE_DISABLE_FIND_PACKAGE_xsimd=ON)
build()
answers("scalar: as on record\nportable128: as on record\n")
