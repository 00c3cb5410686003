# SPDX-License-Identifier: MIT
include(${CMAKE_CURRENT_LIST_DIR}/header_library.cmake)
shaftcull_header_library(nlohmann_json::nlohmann_json nlohmann)
