# SPDX-License-Identifier: MIT
# Turns on the warnings that all of this project's own code is free of.
function(shaftcull_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  if(SHAFTCULL_JOIN_SOURCES AND (CMAKE_CXX_COMPILER_ID MATCHES "Clang" OR target MATCHES "^test_"))
    target_compile_options(${target} PRIVATE -Wno-shadow)  # of names in another source of the group
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)  # false alarms on std::string (GCC bug 105651)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)  # false alarms, as the manual of GCC says
  endif()
  if(CMAKE_SIZEOF_VOID_P EQUAL 4 AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(${target} PRIVATE -Wno-shorten-64-to-32)  # 64-bit indices number bounds that are in memory
  endif()
  if(SHAFTCULL_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
