# SPDX-License-Identifier: MIT
# Checks that an object file of one instruction set defines no function that another translation unit may define too:
# of two such copies the linker takes any, and code with AVX must not run for everybody. Given: NM, OBJECTS (the
# object files), ISA (the name that each of their functions and writable objects must contain).

# Constants (R, V, u) are the same in every unit, whichever copy the linker takes. Clang's only function of its own
# calls std::terminate and nothing else.
cmake_minimum_required(VERSION 3.22)
set(constant R V u)
set(harmless __clang_call_terminate)

foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --defined-only --extern-only ${object} RESULT_VARIABLE result OUTPUT_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${NM} cannot read ${object}")
  endif()
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  set(own 0)
  set(shared "")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^[0-9a-f]+ ([A-Za-z]) (.+)$")
      message(FATAL_ERROR "${NM} wrote \"${line}\", which is not a symbol")
    endif()
    set(kind ${CMAKE_MATCH_1})
    set(symbol ${CMAKE_MATCH_2})
    if(symbol MATCHES ${ISA})
      math(EXPR own "${own} + 1")
    elseif(NOT kind IN_LIST constant AND NOT symbol IN_LIST harmless)
      string(APPEND shared "\n  ${symbol}")
    endif()
  endforeach()
  if(own EQUAL 0)
    message(FATAL_ERROR "${object} defines no symbol with ${ISA} in its name")
  endif()
  if(shared)
    message(FATAL_ERROR "${object} defines symbols without ${ISA} in their names:${shared}")
  endif()
endforeach()
