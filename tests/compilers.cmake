# SPDX-License-Identifier: MIT
# Checks that no source has an attribute, a pragma, a function or assembler of one compiler, except the header that collects these
# words, and those of public headers that are for export. Given: ROOT.
cmake_minimum_required(VERSION 3.22)

set(own_words "__attribute__|__declspec|\\[\\[(gnu|clang|msvc)::|__builtin_|__extension__|__FLT_|__DBL_|__int128|_Pragma|# *pragma|__forceinline")
string(APPEND own_words "|[^A-Za-z_\"]asm[ (]")
# What all have: __builtin_bit_cast() and #pragma once.
set(of_all "__builtin_bit_cast|# *pragma once")
set(known kernel/support/compiler.hpp include/shaftcull/export.hpp include/shaftcull.h
  bench/families/roofline_lanes.hpp  # which measures instructions that a compiler would leave out
  conformance/oracle/sight_integers.hpp)  # whose integers have 128 bits

file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/include/*.h ${ROOT}/include/*.hpp ${ROOT}/kernel/*.hpp ${ROOT}/kernel/*.cpp
  ${ROOT}/bench/*.hpp ${ROOT}/bench/*.cpp ${ROOT}/programs/*.hpp ${ROOT}/programs/*.cpp ${ROOT}/conformance/*.hpp
  ${ROOT}/conformance/*.cpp ${ROOT}/bindings/c/*.hpp ${ROOT}/bindings/c/*.cpp)
list(LENGTH sources count)
if(count LESS 300)
  message(FATAL_ERROR "only ${count} sources were found below ${ROOT}")
endif()
foreach(source IN LISTS known)
  if(NOT source IN_LIST sources)
    message(FATAL_ERROR "there is no ${source}")
  endif()
endforeach()
list(REMOVE_ITEM sources ${known})
foreach(source IN LISTS sources)
  file(STRINGS ${ROOT}/${source} lines REGEX "${own_words}")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "${of_all}|//.*" "" rest "${line}")
    if(rest MATCHES "${own_words}")
      message(SEND_ERROR "${source} has a word of one compiler, which belongs into kernel/support/compiler.hpp: ${line}")
    endif()
  endforeach()
endforeach()
message(STATUS "${count} sources have no word of one compiler")
