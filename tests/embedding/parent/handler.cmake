# SPDX-License-Identifier: MIT
add_executable(handler ${CMAKE_CURRENT_LIST_DIR}/handler.cpp)
target_link_libraries(handler PRIVATE shaftcull::shaftcull)
