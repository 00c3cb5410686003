# SPDX-License-Identifier: MIT
add_executable(handler ${CMAKE_CURRENT_LIST_DIR}/handler.cpp)
target_link_libraries(handler PRIVATE shaftcull::shaftcull)

add_executable(handler_in_c ${CMAKE_CURRENT_LIST_DIR}/handler_in_c.cpp)
target_link_libraries(handler_in_c PRIVATE shaftcull::c)
