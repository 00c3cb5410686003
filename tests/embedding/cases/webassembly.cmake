# SPDX-License-Identifier: MIT
# WebAssembly with vectors of 128 bits, in node. It has neither threads nor exceptions: a handler is told of errors.
set(wasm -stdlib=libc++ -msimd128 -fno-exceptions)
needs(clang++-19 --target=wasm32-wasi ${wasm})
find_program(node node)
if(NOT node)
  skip("there is no node on this machine")
endif()
set(emulator ${node} --experimental-wasi-unstable-preview1 --no-warnings ${CMAKE_CURRENT_LIST_DIR}/../wasi.mjs)
list(JOIN wasm " " flags)
configure(clang++-19 -D CMAKE_SYSTEM_NAME=WASI -D CMAKE_SYSTEM_PROCESSOR=wasm32 -D CMAKE_CXX_COMPILER_TARGET=wasm32-wasi
  -D CMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS=${flags}
  -D SHAFTCULL_WITH_TBB=OFF -D SHAFTCULL_WITH_EXCEPTIONS=OFF
  -D PARENT_MORE=${CMAKE_CURRENT_LIST_DIR}/../parent/hashes.cmake)
build()
answers("scalar: as on record\nportable128: as on record\n")
hashes("scalar: hashes as on record\nportable128: hashes as on record\n")
