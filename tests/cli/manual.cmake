# SPDX-License-Identifier: MIT
# Checks that the manual page names what the program has: every command and no other, options of the command that it
# describes, the version. Given: PROGRAM, PAGE, VERSION.
cmake_minimum_required(VERSION 3.22)

# help(command…): sets `output` to what the program says of itself.
function(help)
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} ${ARGN} --help ended with ${result}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(READ ${PAGE} page)
string(REPLACE ";" "," page "${page}")
string(REPLACE "\\-" "-" page "${page}")
if(NOT page MATCHES "\n\\.TH SHAFTCULL 1 [0-9-]+ \"shaftcull ([0-9.]+)\"")
  message(FATAL_ERROR "${PAGE} has no line .TH that names the version")
endif()
if(NOT CMAKE_MATCH_1 STREQUAL VERSION)
  message(SEND_ERROR "${PAGE} is of version ${CMAKE_MATCH_1}, not ${VERSION}")
endif()

# Entries of the page: .TP, and on the next line the command in bold.
if(NOT page MATCHES "\n\\.SH COMMANDS\n(.*)\n\\.SH OPTIONS\n")
  message(FATAL_ERROR "${PAGE} has no section COMMANDS before one OPTIONS")
endif()
string(REGEX REPLACE "(^|\n)\\.TP\n" ";" entries "${CMAKE_MATCH_1}")
list(REMOVE_AT entries 0)
set(described "")
set(options 0)
foreach(entry IN LISTS entries)
  string(REGEX MATCH "^\\.BI? ([a-z-]+)" name "${entry}")
  set(name ${CMAKE_MATCH_1})
  list(APPEND described ${name})
  help(${name})
  string(REGEX MATCHALL "--[a-z-]+" named "${entry}")
  foreach(option IN LISTS named)
    math(EXPR options "${options} + 1")
    if(NOT output MATCHES "\n  (-[a-z],)?${option} ")
      message(SEND_ERROR "${PAGE} names ${option} of ${name}, which does not have it")
    endif()
  endforeach()
endforeach()
if(options LESS 8)
  message(SEND_ERROR "only ${options} options were found in ${PAGE}")
endif()

help()
string(REGEX MATCH "\nSubcommands:\n(.*)\n\n" ignored "${output}")
string(REGEX MATCHALL "\n  [a-z-]+  " commands "\n${CMAKE_MATCH_1}")
list(TRANSFORM commands STRIP)
if(NOT described STREQUAL commands)
  message(SEND_ERROR "${PAGE} describes the commands ${described}; the program has ${commands}")
endif()

# man itself finds nothing wrong with it.
find_program(man man)
if(man)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C.UTF-8 MANROFFSEQ= MANWIDTH=80 ${man} --warnings -E UTF-8 -l -Tutf8 -Z ${PAGE}
    OUTPUT_QUIET ERROR_VARIABLE warnings RESULT_VARIABLE result)
  if(warnings OR NOT result EQUAL 0)
    message(SEND_ERROR "man ended with ${result} and says of ${PAGE}:\n${warnings}")
  endif()
endif()
message(STATUS "${described}: as the program has them")
