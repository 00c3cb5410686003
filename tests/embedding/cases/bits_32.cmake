# SPDX-License-Identifier: MIT
# 32-bit x86 with SSE2, which has portable kernels only. Headers of the kernel are those of 64 bits, which say of each what it has.
execute_process(COMMAND g++ -print-multiarch OUTPUT_VARIABLE system OUTPUT_STRIP_TRAILING_WHITESPACE)
set(bits_32 -m32 -msse2 -mfpmath=sse -idirafter /usr/include/${system})
needs(g++ ${bits_32})
execute_process(COMMAND ${WORK}/probe RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(NOT result EQUAL 0)  # some kernels run no 32-bit programs
  find_program(qemu qemu-i386)
  if(NOT qemu)
    skip("this machine runs no 32-bit programs, and has no qemu-i386")
  endif()
  set(emulator ${qemu})
endif()
list(JOIN bits_32 " " flags)
configure(g++ -D "CMAKE_CXX_FLAGS=${flags} -O0" -D SHAFTCULL_WITH_TBB=OFF -D SHAFTCULL_BUILD_C=ON
  -D CMAKE_DISABLE_FIND_PACKAGE_xsimd=ON)
build()
answers("scalar: as on record\nportable128: as on record\n")
