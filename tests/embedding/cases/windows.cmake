# SPDX-License-Identifier: MIT
# 64-bit Windows by mingw-w64, in wine, with oneTBB off.
needs(x86_64-w64-mingw32-g++-posix)
find_program(wine NAMES wine64 wine PATHS /usr/lib/wine)
if(NOT wine)
  skip("there is no wine64 on this machine")
endif()
# xsimd by itself, as no include folder of this machine belongs in front of the compiler's own.
file(STRINGS ${BUILD}/CMakeCache.txt package REGEX "^xsimd_DIR:")
string(REGEX REPLACE "^[^=]*=" "" package "${package}")
string(REGEX REPLACE "/(lib|share)/.*" "" machine "${package}")
file(RELATIVE_PATH place ${machine} ${package})
file(COPY ${package}/ DESTINATION ${WORK}/prefix/${place})
file(COPY ${machine}/include/xsimd DESTINATION ${WORK}/prefix/include)
configure(x86_64-w64-mingw32-g++-posix -D CMAKE_SYSTEM_NAME=Windows -D CMAKE_SYSTEM_PROCESSOR=x86_64
  -D CMAKE_BUILD_TYPE=Release -D CMAKE_EXE_LINKER_FLAGS=-static -D SHAFTCULL_WITH_TBB=OFF
  -D xsimd_DIR=${WORK}/prefix/${place}
  -D PARENT_MORE=${with_hashes})
build()
# Wine keeps its files in a folder of its own.
set(emulator ${CMAKE_COMMAND} -E env WINEPREFIX=${WORK}/wine WINEDEBUG=-all ${wine})
set(suffix .exe)
run(${emulator} "${WORK}/a parent/client.exe")  # the first program that wine runs also tells of the folder
answers()
string(REPLACE ": as on" ": hashes as on" expected "${output}")
hashes("${expected}")
if(NOT output MATCHES "sse4_2: hashes as on record")
  message(FATAL_ERROR "on Windows, no instruction set of x86 answers:\n${output}")
endif()
