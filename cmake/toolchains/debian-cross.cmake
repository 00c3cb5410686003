# SPDX-License-Identifier: MIT
# Another processor's programs on this machine, by Debian's cross compiler and its libraries of that architecture. They run under
# qemu, where that is installed, so CTest runs the tests as anywhere. Who includes this sets CMAKE_SYSTEM_PROCESSOR.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${CMAKE_SYSTEM_PROCESSOR}-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER ${CMAKE_SYSTEM_PROCESSOR}-linux-gnu-g++)
# Headers are this machine's, and the library needs no development files to be linked.
find_file(ZLIB_LIBRARY libz.so.1 PATHS /usr/lib/${CMAKE_SYSTEM_PROCESSOR}-linux-gnu NO_DEFAULT_PATH)
find_program(SHAFTCULL_EMULATOR qemu-${CMAKE_SYSTEM_PROCESSOR})
if(SHAFTCULL_EMULATOR)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${SHAFTCULL_EMULATOR})
endif()
