# SPDX-License-Identifier: MIT
# What CMake has to know of the system WASI, which it does not name itself: programs are modules of WebAssembly.
set(CMAKE_EXECUTABLE_SUFFIX .wasm)
