# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
shaftcull_header_library(CLI11::CLI11 CLI)
