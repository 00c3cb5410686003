# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
shaftcull_header_library(fmt::fmt fmt)
if(TARGET fmt::fmt)
  set_property(TARGET fmt::fmt PROPERTY INTERFACE_COMPILE_DEFINITIONS FMT_HEADER_ONLY)
endif()
