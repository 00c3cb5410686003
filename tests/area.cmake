# SPDX-License-Identifier: MIT
# shaftcull_test(), which adds the tests of one area. Included by CMakeLists.txt.

# What all test executables, and what they are made of, are compiled with.
function(shaftcull_test_options target)
  target_link_libraries(${target} PRIVATE shaftcull_internals GTest::gmock)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/conformance ${PROJECT_SOURCE_DIR}/kernel)
  target_compile_definitions(${target} PRIVATE SHAFTCULL_GOLDEN_DIR="${CMAKE_CURRENT_SOURCE_DIR}/golden")
  if(SHAFTCULL_WITH_TBB)
    target_link_libraries(${target} PRIVATE TBB::tbb)
    target_compile_definitions(${target} PRIVATE SHAFTCULL_WITH_TBB=1)
  endif()
  shaftcull_warnings(${target})
  # Of the tests alone, not of the library: with little optimisation they take half as long to build, and as long to run.
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms on std::string of a precompiled header.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
  endif()
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*undefined")
    # Undefined behaviour is looked for in the library. In the tests, it would double the time to build them.
    target_compile_options(${target} PRIVATE -fno-sanitize=undefined)
  endif()
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize" AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # Where a sanitizer watches, tests without inlining are built in a third of the time, and run as fast.
    target_compile_options(${target} PRIVATE -fno-inline-functions)
  endif()
  if(shaftcull_emulates_processor)
    target_compile_definitions(${target} PRIVATE SHAFTCULL_EMULATED)
  endif()
endfunction()

# main() and what systems do in different ways, compiled once; and the headers that most tests include, precompiled: reading them
# takes longer than compiling most tests.
add_library(shaftcull_test_main OBJECT
  aligned_heap_${shaftcull_system}.cpp
  environment_${shaftcull_system}.cpp
  main.cpp)
if(shaftcull_wasm)
  target_sources(shaftcull_test_main PRIVATE
    attempt_wasi.cpp
    pages_wasi.cpp
    ${PROJECT_SOURCE_DIR}/bindings/web/src/thread_exit.cpp)
else()
  target_sources(shaftcull_test_main PRIVATE pages_${shaftcull_system}.cpp)
endif()
shaftcull_test_options(shaftcull_test_main)
if(SHAFTCULL_JOIN_SOURCES)  # without which each source has to include all it needs
  target_precompile_headers(shaftcull_test_main PRIVATE
    <gmock/gmock.h> <gtest/gtest.h> <algorithm> <array> <cmath> <cstdint> <functional> <limits> <span> <string> <vector>
    <shaftcull/shaftcull.hpp> <many/workload.hpp>)
endif()

# shaftcull_test(AREA [EVERY_ISA | PARTS n] source…): the executable test_AREA and the CTest entry AREA; with EVERY_ISA,
# AREA.scalar, AREA.avx2, …, of which those that the machine lacks are skipped; with PARTS, AREA.part0, AREA.part1, …, the tests
# dealt out to so many runs, for tests that go through all instruction sets themselves: what exact arithmetic takes most of its
# time for is then computed once for all of them.
function(shaftcull_test area)
  cmake_parse_arguments(PARSE_ARGV 1 arg "EVERY_ISA" "PARTS" "")
  add_executable(test_${area} $<TARGET_OBJECTS:shaftcull_test_main> ${arg_UNPARSED_ARGUMENTS})
  shaftcull_test_options(test_${area})
  if(shaftcull_wasm)  # what cmake/toolchains/wasi/run.mjs calls functions with
    target_link_options(test_${area} PRIVATE LINKER:--export=__stack_pointer,--export-table,-z,stack-size=8388608)
  endif()
  get_target_property(headers shaftcull_test_main PRECOMPILE_HEADERS)
  if(headers)
    target_precompile_headers(test_${area} REUSE_FROM shaftcull_test_main)
  endif()
  set_target_properties(test_${area} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} UNITY_BUILD ${SHAFTCULL_JOIN_SOURCES})
  add_dependencies(shaftcull_tests test_${area})
  if(arg_PARTS)
    math(EXPR last "${arg_PARTS} - 1")
    foreach(part RANGE ${last})
      add_test(NAME ${area}.part${part} COMMAND test_${area})
      set(environment GTEST_TOTAL_SHARDS=${arg_PARTS} GTEST_SHARD_INDEX=${part} ${shaftcull_test_environment})
      set_tests_properties(${area}.part${part} PROPERTIES ENVIRONMENT "${environment}" TIMEOUT ${shaftcull_test_seconds})
    endforeach()
    return()
  endif()
  if(NOT arg_EVERY_ISA)
    add_test(NAME ${area} COMMAND test_${area})
    set_tests_properties(${area} PROPERTIES ENVIRONMENT "${shaftcull_test_environment}" TIMEOUT ${shaftcull_test_seconds})
    return()
  endif()
  if(area IN_LIST shaftcull_long_areas)
    if(shaftcull_emulates_processor)
      set(isas ${shaftcull_best_set})
    elseif(CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")
      set(isas scalar ${shaftcull_best_set})  # threads share work in one way on all sets
    elseif(CMAKE_CXX_FLAGS MATCHES "-fsanitize" AND area STREQUAL "tree_building")
      set(isas ${shaftcull_best_set})  # all sets share most of this code; tests of the rest go through all sets themselves
    elseif(CMAKE_CXX_FLAGS MATCHES "-fsanitize" AND "sse4_2" IN_LIST isas)
      list(REMOVE_ITEM isas portable128)  # reads and writes four floats at a time, too
    endif()
  endif()
  foreach(isa IN LISTS isas)
    add_test(NAME ${area}.${isa} COMMAND test_${area})
    set_tests_properties(${area}.${isa} PROPERTIES
      ENVIRONMENT SHAFTCULL_ISA=${isa} SKIP_RETURN_CODE 77 TIMEOUT ${shaftcull_test_seconds})
  endforeach()
endfunction()
