# SPDX-License-Identifier: MIT
# A big-endian processor on another machine, s390x: Debian's cross compiler and its libraries of that architecture (libtbb-dev:s390x
# and so on). Programs run under qemu-s390x, where that is installed, so CTest runs the tests as anywhere.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR s390x)
set(CMAKE_C_COMPILER s390x-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER s390x-linux-gnu-g++)
find_program(SHAFTCULL_EMULATOR qemu-s390x)
if(SHAFTCULL_EMULATOR)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${SHAFTCULL_EMULATOR})
endif()
