# SPDX-License-Identifier: MIT
# Runs test files with pytest. Given: PYTHON, and FILES.
cmake_minimum_required(VERSION 3.22)

execute_process(COMMAND ${PYTHON} -c "import pytest" RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(NOT status EQUAL 0)
  message(STATUS "skipped: ${PYTHON} has no module named pytest (Debian: python3-pytest)")
  return()
endif()
execute_process(COMMAND ${PYTHON} -m pytest -q -rs -p no:cacheprovider ${FILES} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "tests failed")
endif()
