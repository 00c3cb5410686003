# SPDX-License-Identifier: MIT
# Checks that docs/third-party.md lists what is linked and compiled in, and Debian's copyright file what is compiled
# in. Given: ROOT, the project.
cmake_minimum_required(VERSION 3.22)

file(READ ${ROOT}/docs/third-party.md page)
file(READ ${ROOT}/cmake/packaging/debian/copyright copyright)
string(TOLOWER "${copyright}" copyright)

# What CMake looks for: shaftcull_dependency(NAME …) for the library, the program and tests; find_package(NAME …) elsewhere.
file(GLOB_RECURSE lists ${ROOT}/cmake/*.cmake ${ROOT}/kernel/CMakeLists.txt ${ROOT}/bench/CMakeLists.txt ${ROOT}/programs/CMakeLists.txt
  ${ROOT}/bindings/CMakeLists.txt ${ROOT}/tests/CMakeLists.txt)
list(FILTER lists EXCLUDE REGEX "/tests/(consumer|embedding|dependencies)/")
set(tools Python3 Python Doxygen Git Threads)  # which leave nothing in what is built
set(names "")
foreach(list IN LISTS lists)
  file(STRINGS ${list} lines REGEX "^ *(shaftcull_dependency|find_package)\\(")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "\\(([A-Za-z0-9_]+)")  # a name in a variable: cmake/dependency.cmake looks for what others name
      continue()
    endif()
    set(name ${CMAKE_MATCH_1})
    list(APPEND names ${name})
    if(NOT name IN_LIST tools AND NOT page MATCHES "\n\\| ${name} \\| [^|]+ \\|")
      message(SEND_ERROR "${list} looks for ${name}, which has no row in docs/third-party.md")
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES names)
list(LENGTH names count)
if(count LESS 9)
  message(FATAL_ERROR "only ${count} dependencies were found: ${names}")
endif()

# What is compiled in has its notice in the packages.
string(REGEX MATCHALL "\n\\| [^|\n]+ \\| [^|\n]+ \\| [^|\n]+ \\| headers, compiled in[^\n]*" rows "${page}")
list(LENGTH rows count)
if(count LESS 5)
  message(FATAL_ERROR "only ${count} rows of docs/third-party.md say what is compiled in")
endif()
foreach(row IN LISTS rows)
  string(REGEX MATCH "^\n\\| ([^ |]+)" name "${row}")
  string(REPLACE _ - name ${CMAKE_MATCH_1})
  string(TOLOWER ${name} name)
  if(NOT copyright MATCHES "\n ${name}, in [^:]+: copyright ")
    message(SEND_ERROR "${CMAKE_MATCH_1} is compiled in, and cmake/packaging/debian/copyright has no notice of it")
  endif()
endforeach()

# The licence of the project itself is everywhere the same.
file(READ ${ROOT}/LICENSE license)
string(REGEX REPLACE "[ \n]+" " " license "${license}")
string(REGEX MATCH "Permission is hereby granted.*" license "${license}")
file(READ ${ROOT}/cmake/packaging/debian/copyright copyright)
string(REPLACE "\n .\n" "\n" copyright "${copyright}")
string(REGEX REPLACE "[ \n]+" " " copyright "${copyright}")
string(FIND "${copyright}" "${license}" place)
if(place EQUAL -1)
  message(SEND_ERROR "cmake/packaging/debian/copyright does not have the text of LICENSE")
endif()
message(STATUS "dependencies: ${names}")
