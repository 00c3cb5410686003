# SPDX-License-Identifier: MIT
# 64-bit Windows, by Debian's mingw-w64 (g++-mingw-w64-x86-64-posix). Programs run under wine (wine64), where that is installed, so
# CTest runs the tests as anywhere.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
# Programs run by themselves: the compiler's own libraries are in them.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)
# Libraries are those of Windows, never this machine's.
list(APPEND CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Debian has few libraries of Windows. Those that can be had without are found by the modules there.
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/from_sources)

find_program(SHAFTCULL_WINE NAMES wine64 wine PATHS /usr/lib/wine)
get_property(shaftcull_tries_to_compile GLOBAL PROPERTY IN_TRY_COMPILE)
if(SHAFTCULL_WINE AND NOT shaftcull_tries_to_compile)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/mingw/wine.sh.in ${CMAKE_BINARY_DIR}/wine.sh @ONLY)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_BINARY_DIR}/wine.sh)
  if(NOT EXISTS ${CMAKE_BINARY_DIR}/wine/system.reg)  # made now, and not by several tests at the same time
    execute_process(COMMAND ${CMAKE_CROSSCOMPILING_EMULATOR} wineboot --init OUTPUT_QUIET ERROR_QUIET)
  endif()
endif()
