# SPDX-License-Identifier: MIT
# Configuring for another system: xsimd is not asked for where no instruction set uses it, and no folder of this machine's is
# put in front of the other's.
needs(clang++-14)
set(cross -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY -D SHAFTCULL_WITH_TBB=OFF)
configure(clang++-14 ${cross} -D CMAKE_SYSTEM_PROCESSOR=aarch64 -D CMAKE_CXX_COMPILER_TARGET=aarch64-linux-gnu
  -D CMAKE_DISABLE_FIND_PACKAGE_xsimd=ON)
if(commands MATCHES "sets/(sse|avx|portable)" OR NOT commands MATCHES "sets/scalar" OR NOT commands MATCHES "sets/neon")
  message(FATAL_ERROR "for ARM, kernels of other processors are compiled, or not those of ARM:\n${commands}")
endif()
file(REMOVE_RECURSE "${WORK}/a parent")

file(STRINGS ${BUILD}/CMakeCache.txt xsimd REGEX "^xsimd_DIR:")
configure(clang++-14 ${cross} -D ${xsimd} -D CMAKE_SYSTEM_PROCESSOR=x86_64 -D CMAKE_CXX_COMPILER_TARGET=x86_64-linux-musl)
if(commands MATCHES "-(isystem|I) */usr/[^ ]*" OR NOT commands MATCHES "sets/avx2")
  message(FATAL_ERROR "for another system, a folder of this one is on the include path: ${CMAKE_MATCH_0}")
endif()
