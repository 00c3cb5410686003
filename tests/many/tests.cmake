# SPDX-License-Identifier: MIT
# Calls for many shafts.

shaftcull_test(many EVERY_ISA
  many/calls.cpp
  many/one_shaft.cpp
  many/outputs.cpp
  many/set_bits.cpp
  many/sizes.cpp)

# On threads of the caller's.
if(NOT shaftcull_wasm)
  shaftcull_test(executor
    many/executor.cpp)
endif()

# Whether ThreadSanitizer would notice a race among those of `many`.
if(SHAFTCULL_WITH_TBB AND CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")
  # Without it nothing in cmake/tsan.suppressions has a name to match.
  find_program(SHAFTCULL_SYMBOLIZER llvm-symbolizer)
  if(NOT SHAFTCULL_SYMBOLIZER)
    message(FATAL_ERROR "ThreadSanitizer needs llvm-symbolizer in the PATH to know false reports (Debian: llvm)")
  endif()
  add_executable(test_planted_race many/planted_race.cpp)
  target_link_libraries(test_planted_race PRIVATE shaftcull_internals TBB::tbb)
  target_include_directories(test_planted_race PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/conformance
    ${PROJECT_SOURCE_DIR}/kernel)
  target_compile_definitions(test_planted_race PRIVATE SHAFTCULL_WITH_TBB=1)
  set_target_properties(test_planted_race PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  shaftcull_warnings(test_planted_race)
  add_dependencies(shaftcull_tests test_planted_race)
  foreach(place IN ITEMS loop pipeline)
    add_test(NAME many.planted_race.${place} COMMAND test_planted_race ${place})
    set_tests_properties(many.planted_race.${place} PROPERTIES
      PASS_REGULAR_EXPRESSION "SUMMARY: ThreadSanitizer: data race [^\n]*planted_race.cpp" TIMEOUT 300)
  endforeach()
endif()
