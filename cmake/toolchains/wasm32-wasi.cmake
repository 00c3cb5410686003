# SPDX-License-Identifier: MIT
# WebAssembly with vectors of 128 bits (Debian: clang-19, lld-19, libc++-19-dev-wasm32, wasi-libc, libclang-rt-19-dev-wasm32).
# Programs run in Node.js, where that is installed, so CTest runs the tests as anywhere.
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})  # Platform/WASI.cmake
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_FLAGS_INIT "-stdlib=libc++ -msimd128 -fno-exceptions")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # what is tried out need not find main()
# Libraries are those of WebAssembly, never this machine's; Debian has none but the compiler's. Those that can be had without are
# found by the modules there.
list(APPEND CMAKE_FIND_ROOT_PATH /usr/lib/wasm32-wasi)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/from_sources)

find_program(SHAFTCULL_NODE node)
get_property(shaftcull_tries_to_compile GLOBAL PROPERTY IN_TRY_COMPILE)
if(SHAFTCULL_NODE AND NOT shaftcull_tries_to_compile)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/wasi/node.sh.in ${CMAKE_BINARY_DIR}/node.sh @ONLY)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_BINARY_DIR}/node.sh)
endif()
