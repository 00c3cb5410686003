# SPDX-License-Identifier: MIT
# 64-bit ARM on another machine: Debian's cross compiler and its libraries of that architecture (libtbb-dev:arm64 and so on).
# Programs run under qemu-aarch64, where that is installed, so CTest runs the tests as anywhere.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
find_program(SHAFTCULL_EMULATOR qemu-aarch64)
if(SHAFTCULL_EMULATOR)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${SHAFTCULL_EMULATOR})
endif()
