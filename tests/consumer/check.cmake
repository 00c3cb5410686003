# SPDX-License-Identifier: MIT
# Installs the library below WORK, builds the consumer against what is installed there, and checks what it prints.
# Given: BUILD (the library's build tree), WORK, CONFIG, GENERATOR, COMPILER, FLAGS; for another processor TOOLCHAIN, a file of
# CMake's, and EMULATOR, which runs programs; and SUFFIX, which names of programs end in.

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nfailed with ${result}:\n${output}")
  endif()
  string(REPLACE "\r\n" "\n" output "${output}")  # lines as Windows ends them
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
foreach(component IN ITEMS shaftcull_runtime shaftcull_development)
  run(${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --component ${component} --prefix ${WORK}/prefix)
endforeach()
set(toolchain "")
if(TOOLCHAIN)
  # A toolchain may look for packages in its own folders alone.
  set(toolchain -D CMAKE_TOOLCHAIN_FILE=${TOOLCHAIN} -D CMAKE_FIND_ROOT_PATH=${WORK}/prefix)
endif()
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS} -D CMAKE_BUILD_TYPE=${CONFIG}
  -D CMAKE_RUNTIME_OUTPUT_DIRECTORY=${WORK}/bin -D CMAKE_RUNTIME_OUTPUT_DIRECTORY_${CONFIG}=${WORK}/bin
  -D CMAKE_PREFIX_PATH=${WORK}/prefix ${toolchain})
run(${CMAKE_COMMAND} --build ${WORK}/build --config ${CONFIG})
run(${EMULATOR} ${WORK}/bin/consumer${SUFFIX})
if(NOT output STREQUAL "kept 1\n")
  message(FATAL_ERROR "the consumer printed \"${output}\" instead of \"kept 1\"")
endif()

# docs/packages.md promises that --gc-sections leaves 1.5 MB out of a program that links the static library on x86-64. On 64-bit ARM,
# it leaves 1.3 MB out.
if(CONFIG STREQUAL "Release" AND EXISTS ${WORK}/bin/consumer_small AND NOT EXISTS ${WORK}/prefix/lib/libshaftcull.so)
  run(${EMULATOR} ${WORK}/bin/consumer_small)
  file(SIZE ${WORK}/bin/consumer_whole whole)
  file(SIZE ${WORK}/bin/consumer_small small)
  math(EXPR left_out "${whole} - ${small}")
  set(promised 1400000)
  if(TOOLCHAIN)
    set(promised 1150000)
  endif()
  if(left_out LESS promised)
    message(FATAL_ERROR "with --gc-sections the consumer has ${small} bytes of ${whole}: too little is left out")
  endif()
  message(STATUS "with --gc-sections the consumer has ${small} bytes of ${whole}")
endif()

# The same from C, where the C interface was built.
if(EXISTS ${WORK}/prefix/include/shaftcull.h)
  run(${EMULATOR} ${WORK}/bin/consumer_c${SUFFIX})
  if(NOT output STREQUAL "kept 1\n")
    message(FATAL_ERROR "the consumer in C printed \"${output}\" instead of \"kept 1\"")
  endif()
endif()

# The package must not name anything that only building the library needs.
file(GLOB package ${WORK}/prefix/lib*/cmake/shaftcull/*.cmake ${WORK}/prefix/lib/*/cmake/shaftcull/*.cmake)
if(NOT package)
  message(FATAL_ERROR "no CMake package below ${WORK}/prefix")
endif()
foreach(file IN LISTS package)
  file(READ ${file} text)
  if(text MATCHES "xsimd" OR text MATCHES "${BUILD}")
    message(FATAL_ERROR "${file} names \"${CMAKE_MATCH_0}\", which its user may not have")
  endif()
endforeach()
