# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/../../header_version.cmake)
shaftcull_header_library(xsimd xsimd)
if(TARGET xsimd)
  shaftcull_header_version(xsimd_VERSION ${SHAFTCULL_HEADERS_xsimd}/xsimd/config/xsimd_config.hpp XSIMD_VERSION MAJOR MINOR PATCH)
endif()
