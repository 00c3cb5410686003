# SPDX-License-Identifier: MIT
# Runs one case. Given: CASE, and what steps.cmake needs.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
# A build is as its own flags say, not as those of whoever runs the tests.
foreach(variable IN ITEMS CXX CXXFLAGS LDFLAGS CMAKE_BUILD_TYPE)
  unset(ENV{${variable}})
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/cases/${CASE}.cmake)
file(REMOVE_RECURSE ${WORK})
