# SPDX-License-Identifier: MIT
# The library is optimised where nobody says how: not where the parent says how, or asks for a debug build.
needs(g++)

# optimised(yes|no option…): what flags the library's sources have.
function(optimised expected)
  configure(g++ ${ARGN})
  string(REGEX MATCH "\"command\": \"[^\n]*kernel/formation/join.cpp" command "${commands}")
  set(found no)
  if(command MATCHES " -O3 ")
    set(found yes)
  endif()
  if(NOT command OR NOT found STREQUAL expected)
    message(FATAL_ERROR "-O3 with ${ARGN}: ${found} instead of ${expected}\n${command}")
  endif()
  file(REMOVE_RECURSE "${WORK}/a parent")
endfunction()

optimised(yes)
optimised(no -D CMAKE_BUILD_TYPE=Debug)
optimised(no -D PARENT_OPTIONS=-O1)
optimised(no -D CMAKE_CXX_FLAGS=-Og)
optimised(yes -D CMAKE_BUILD_TYPE=Release)
