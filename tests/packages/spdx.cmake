# SPDX-License-Identifier: MIT
# Checks that each source says its licence in its first line, or in the second behind what runs a script. Given: ROOT, the
# project.
cmake_minimum_required(VERSION 3.22)

set(kinds [ch]pp [ch] cmake sh py pyi)
set(folders bench bindings cmake conformance docs include kernel programs tests)
set(sources CMakeLists.txt cmake/run .ci/run)
foreach(folder IN LISTS folders)
  foreach(kind IN LISTS kinds)
    file(GLOB_RECURSE found RELATIVE ${ROOT} ${ROOT}/${folder}/*.${kind})
    list(APPEND sources ${found})
  endforeach()
  file(GLOB_RECURSE found RELATIVE ${ROOT} ${ROOT}/${folder}/CMakeLists.txt)
  list(APPEND sources ${found})
endforeach()

list(FILTER sources EXCLUDE REGEX "/examples/[^/]*[.](c|cpp|py)$")  # pages show them as they stand, to be copied
list(FILTER sources EXCLUDE REGEX "/build/")  # what Python's tools make

foreach(source IN LISTS sources)
  if(source MATCHES "\\.([ch]pp|[ch])$")
    set(line "// SPDX-License-Identifier: MIT")
  else()
    set(line "# SPDX-License-Identifier: MIT")
  endif()
  file(READ ${ROOT}/${source} text LIMIT 200)
  if(NOT text MATCHES "^(#![^\n]*\n)?${line}\n")
    message(SEND_ERROR "${source} does not begin with \"${line}\"; ./cmake/run format adds it")
    set(lacking TRUE)
  endif()
endforeach()
list(LENGTH sources count)
if(count LESS 600)
  message(FATAL_ERROR "only ${count} sources were found in ${ROOT}")
endif()
if(NOT lacking)
  message(STATUS "${count} sources say their licence")
endif()
