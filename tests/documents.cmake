# SPDX-License-Identifier: MIT
# Checks that the files which pages name exist: links to files, and paths like `tests/main.cpp`. Given: ROOT, the project.
cmake_minimum_required(VERSION 3.22)

# What a page tells its reader to write.
set(examples kernel/simd/arm/neon.hpp kernel/kernels/sets/neon_kernels.cpp)

file(GLOB pages ${ROOT}/*.md ${ROOT}/docs/*.md)
file(GLOB_RECURSE more ${ROOT}/kernel/*.md ${ROOT}/bench/*.md ${ROOT}/tests/*.md)
set(references 0)
foreach(page IN LISTS pages more)
  cmake_path(GET page PARENT_PATH folder)
  file(READ ${page} text)
  string(REGEX REPLACE "[][;]" " " text "${text}")  # they have a meaning in lists
  string(REGEX MATCHALL "\\([A-Za-z0-9_./-]+\\.(md|hpp|svg)[)#]" links "${text}")
  string(REGEX MATCHALL "`(kernel|include|bindings|programs|conformance|bench|tests|docs|cmake)/[A-Za-z0-9_./-]+`" paths "${text}")
  foreach(reference IN LISTS links paths)
    string(REGEX REPLACE "^[(`]|[)#`]$" "" path "${reference}")
    math(EXPR references "${references} + 1")
    if(NOT EXISTS ${folder}/${path} AND NOT EXISTS ${ROOT}/${path} AND NOT path IN_LIST examples)
      message(SEND_ERROR "${page} names ${path}, which does not exist")
    endif()
  endforeach()
endforeach()
if(references LESS 50)
  message(FATAL_ERROR "only ${references} references were found in ${ROOT}")
endif()
message(STATUS "${references} references to files that exist")
