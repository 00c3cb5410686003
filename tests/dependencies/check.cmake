# SPDX-License-Identifier: MIT
# Configures a small project that asks for libraries that are missing, broken, too old, too new or sound, and reads what is printed.
# Given: PROJECT_CMAKE (the folder cmake/ of the project), WORK, GENERATOR.
cmake_minimum_required(VERSION 3.22)

# expect(KIND RESULT text): configuring with KIND ends with RESULT (0 or 1) and prints text, on however many lines.
function(expect kind expected text)
  file(REMOVE_RECURSE ${WORK})
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK} -G ${GENERATOR} -D KIND=${kind}
            -D PROJECT_CMAKE=${PROJECT_CMAKE}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " one_line "${output}")
  string(FIND "${one_line}" "${text}" at)
  if(NOT result EQUAL expected OR at EQUAL -1)
    message(SEND_ERROR "${kind}: expected result ${expected} and \"${text}\", got ${result}:\n${output}")
  endif()
endfunction()

expect(Missing 1 "The program cannot be built without Missing 2.1 or newer, which was not found (Debian: libfirst-dev and libsecond-dev).")
expect(Old 1 "The program cannot be built without Old 2.1 or newer, which was found only in version 2.0 (/opt/old) (Debian: libfirst-dev and")
expect(New 1 "The program cannot be built without New 2.1 or newer but before 4, which was found only in version 4.0 (/opt/new) (Debian:")
expect(Broken 1 "The program cannot be built without Broken 2.1 or newer, which is broken: it links /nowhere/libz.so, which does not exist (Debian:")
expect(Optional 0 "The program has no reader, because Optional 2.1 or newer was not found (Debian: libfirst-dev and libsecond-dev).")
expect(Optional 0 "found: FALSE")
expect(Sound 0 "found: TRUE")
file(REMOVE_RECURSE ${WORK})
