# SPDX-License-Identifier: MIT
# Checks that the public headers include each other and the standard library only. Given: INCLUDE, their folder.

file(GLOB headers ${INCLUDE}/shaftcull/*.hpp)
if(NOT headers)
  message(FATAL_ERROR "no headers in ${INCLUDE}/shaftcull")
endif()
foreach(header IN LISTS headers)
  file(STRINGS ${header} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^#include (<[a-z_]+>|\"shaftcull/[a-z_]+\\.hpp\")$")
      message(FATAL_ERROR "${header} has ${line}: neither a header of this library nor of the standard one")
    endif()
  endforeach()
endforeach()
