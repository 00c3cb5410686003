# SPDX-License-Identifier: MIT
# shaftcull_header_version(RESULT HEADER PREFIX PART…): the numbers that a header defines as PREFIX_PART, joined by points.
function(shaftcull_header_version result header prefix)
  set(numbers "")
  foreach(part IN LISTS ARGN)
    file(STRINGS ${header} line REGEX "^#define ${prefix}_${part}[ \t]+[0-9]+" LIMIT_COUNT 1)
    string(REGEX REPLACE "^#define ${prefix}_${part}[ \t]+([0-9]+).*" "\\1" number "${line}")
    list(APPEND numbers ${number})
  endforeach()
  list(JOIN numbers "." version)
  set(${result} ${version} PARENT_SCOPE)
endfunction()
