# SPDX-License-Identifier: MIT
# Checks that a shared library exports the interface and nothing else: every symbol is named in a public header, and none is
# in shaftcull::kernel. Given: NM, LIBRARY, INCLUDE (the folder of the public headers).
cmake_minimum_required(VERSION 3.22)

# Every program has its own copies of these, all the same.
set(of_the_compiler "^([a-z ]+ )?(std|__gnu_cxx)::|^_init$|^_fini$")

execute_process(COMMAND ${NM} --dynamic --defined-only --extern-only --demangle ${LIBRARY}
  RESULT_VARIABLE result OUTPUT_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${NM} cannot read ${LIBRARY}")
endif()
file(GLOB headers ${INCLUDE}/shaftcull/*.hpp)
set(declared "")
foreach(header IN LISTS headers)
  file(READ ${header} text)
  string(APPEND declared "${text}")
endforeach()

string(REGEX REPLACE "[][;]" "_" output "${output}")  # these would split a list otherwise
string(REGEX MATCHALL "[^\n]+" lines "${output}")
set(interface 0)
set(others "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^[0-9a-f]+ [A-Za-z] " "" symbol "${line}")
  if(symbol MATCHES "${of_the_compiler}")
    continue()
  endif()
  # The name that a header must have: of "void shaftcull::list_many<unsigned int>(…)" it is list_many.
  set(name "")
  if(NOT symbol MATCHES "^[^(]*shaftcull::kernel::" AND symbol MATCHES "(^| )shaftcull::([A-Za-z_]+)")
    set(name ${CMAKE_MATCH_2})
  endif()
  if(NOT name OR NOT declared MATCHES "[^A-Za-z_]${name}[^A-Za-z_]")
    string(APPEND others "\n  ${symbol}")
  else()
    math(EXPR interface "${interface} + 1")
  endif()
endforeach()
if(others)
  message(FATAL_ERROR "${LIBRARY} exports what is not of the interface:${others}")
endif()
if(interface EQUAL 0)
  message(FATAL_ERROR "${LIBRARY} exports nothing of the interface")
endif()

# What is thrown has its type here; bindings/c/tests/symbols.cmake checks that another library has none of its own.
execute_process(COMMAND ${NM} --dynamic --defined-only --extern-only ${LIBRARY} OUTPUT_VARIABLE mangled)
foreach(error 15InvalidArgument 8BadBound 10NeedsRefit 9Cancelled)
  if(NOT mangled MATCHES " [DV] _ZTIN9shaftcull${error}E\n")
    message(FATAL_ERROR "${LIBRARY} does not export the typeinfo of shaftcull::${error}")
  endif()
endforeach()
message(STATUS "${interface} symbols, all of the interface")
