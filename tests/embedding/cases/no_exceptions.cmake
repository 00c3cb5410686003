# SPDX-License-Identifier: MIT
# A program and a library without exceptions: the same answers, and a handler is told of errors. Each source is compiled by itself,
# so that it has to include what it needs.
needs(g++ -fno-exceptions)
configure(g++ -D CMAKE_BUILD_TYPE=Debug -D SHAFTCULL_JOIN_SOURCES=OFF -D SHAFTCULL_WITH_EXCEPTIONS=OFF -D SHAFTCULL_BUILD_C=ON
  -D PARENT_OPTIONS=-fno-exceptions
  -D PARENT_MORE=${CMAKE_CURRENT_LIST_DIR}/../parent/handler.cmake)
build()
answers()

foreach(program IN ITEMS handler handler_in_c)
  execute_process(COMMAND "${WORK}/a parent/${program}" --handle RESULT_VARIABLE result OUTPUT_VARIABLE output)
  if(NOT result EQUAL 7 OR NOT output MATCHES "^told: .* is above ")
    message(FATAL_ERROR "${program} is not told: ${result}, ${output}")
  endif()
  execute_process(COMMAND "${WORK}/a parent/${program}" RESULT_VARIABLE result ERROR_VARIABLE output)
  if(result EQUAL 0 OR NOT output MATCHES "^shaftcull: .* is above ")
    message(FATAL_ERROR "without a handler ${program} goes on, or does not say why it ends: ${result}, ${output}")
  endif()
endforeach()

# What catches exceptions is not built without them.
fails("builds the library and its C interface alone; add -D SHAFTCULL_BUILD_PROGRAM=OFF" ${CMAKE_COMMAND} -S ${SHAFTCULL} -B ${WORK}/alone -G ${GENERATOR}
  -D SHAFTCULL_WITH_EXCEPTIONS=OFF -D SHAFTCULL_BUILD_PROGRAM=ON)
