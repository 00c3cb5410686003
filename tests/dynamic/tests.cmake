# SPDX-License-Identifier: MIT
# Dynamic trees.

shaftcull_test(dynamic EVERY_ISA
  dynamic/agreement.cpp
  dynamic/errors.cpp
  dynamic/images.cpp
  dynamic/upkeep.cpp)

if(NOT shaftcull_wasm)
  shaftcull_test(dynamic_threads
    dynamic/threads.cpp)
endif()
