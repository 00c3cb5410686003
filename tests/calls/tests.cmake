# SPDX-License-Identifier: MIT
# What is promised of every public call.
shaftcull_test(calls EVERY_ISA
  calls/arguments.cpp
  calls/every_call.cpp
  calls/never_formed.cpp)
if(NOT shaftcull_wasm)
  target_sources(test_calls PRIVATE calls/float_state.cpp calls/inside_tasks.cpp calls/odd_surroundings.cpp)
endif()
if(UNIX)
  target_sources(test_calls PRIVATE calls/forked_child.cpp calls/stack.cpp)
  add_test(NAME calls.aarch64
    COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/calls/aarch64.sh ${CMAKE_CURRENT_SOURCE_DIR}/calls/float_state_aarch64.cpp
            ${PROJECT_SOURCE_DIR}/kernel ${CMAKE_CURRENT_BINARY_DIR}/float_state_aarch64)
  set_tests_properties(calls.aarch64 PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 60)
endif()
