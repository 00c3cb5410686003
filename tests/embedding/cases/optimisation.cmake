# SPDX-License-Identifier: MIT
# The library is optimised where nobody says how: not where the parent says how, or asks for a debug build. Instruction sets with
# flags are optimised there, too, so that they define no function that another source may define.
needs(g++)

# optimised(library set option…): the last level of optimisation that these options give the library's sources, and those of AVX2.
function(optimised library set)
  configure(g++ ${ARGN})
  foreach(source wanted IN ZIP_LISTS sources ARGV)
    string(REGEX MATCH "\"command\": \"[^\n]*kernel/${source}" command "${commands}")
    string(REGEX REPLACE ".* -O([^ ]*) .*" "\\1" level " -O0 ${command}")
    if(source STREQUAL "formation/join.cpp" AND NOT command)
      message(FATAL_ERROR "there is no command for ${source}: ${commands}")
    endif()
    if(source AND command AND NOT level STREQUAL wanted)
      message(FATAL_ERROR "${source} is compiled with -O${level} instead of -O${wanted}: ${ARGN}\n${command}")
    endif()
  endforeach()
  file(REMOVE_RECURSE "${WORK}/a parent")
endfunction()

set(sources formation/join.cpp kernels/sets/avx2_kernels.cpp)
optimised(3 3)
optimised(0 3 -D CMAKE_BUILD_TYPE=Debug)
optimised(0 3 -D CMAKE_BUILD_TYPE=Coverage -D CMAKE_CXX_FLAGS_COVERAGE=--coverage)
optimised(s 3 -D CMAKE_BUILD_TYPE=MinSizeRel)
optimised(1 1 -D PARENT_OPTIONS=-O1)
optimised(g 3 -D CMAKE_CXX_FLAGS=-Og)
optimised(3 3 -D CMAKE_BUILD_TYPE=Release)

configure(g++ -D CMAKE_BUILD_TYPE=MinSizeRel)
if(commands MATCHES "avx2_kernels.cpp")
  run(${CMAKE_COMMAND} --build "${WORK}/a parent" --target shaftcull_avx2)
  file(GLOB_RECURSE object "${WORK}/a parent/avx2_kernels.cpp.o")
  run(${CMAKE_COMMAND} -D NM=nm "-DOBJECTS=${object}" -D ISA=avx2 -P ${SHAFTCULL}/tests/symbols.cmake)
endif()
