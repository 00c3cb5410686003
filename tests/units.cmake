# SPDX-License-Identifier: MIT
# Checks that no kernel asks what the compiler may use, which a parent project's -march=native changes for all units: what a set
# may use, its own header in kernel/simd knows. Given: KERNEL, the library's sources.
cmake_minimum_required(VERSION 3.22)

file(GLOB_RECURSE sources ${KERNEL}/*.hpp ${KERNEL}/*.cpp)
if(NOT sources)
  message(FATAL_ERROR "no sources in ${KERNEL}")
endif()
list(REMOVE_ITEM sources ${KERNEL}/simd/baseline.hpp)  # which is there to ask
foreach(source IN LISTS sources)
  file(STRINGS ${source} asks REGEX "^ *# *(if|elif).*__(ARM_|AVX|FMA|F16C|BMI|LZCNT|POPCNT|SSE3|SSSE3|SSE4)")
  if(asks)
    message(SEND_ERROR "${source} asks what the compiler may use: ${asks}")
  endif()
endforeach()
