# SPDX-License-Identifier: MIT
# GoogleTest of its sources (Debian: googletest), which the tests are built with.
find_path(SHAFTCULL_GOOGLETEST_SOURCES googlemock/CMakeLists.txt PATHS /usr/src/googletest NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
mark_as_advanced(SHAFTCULL_GOOGLETEST_SOURCES)
if(SHAFTCULL_GOOGLETEST_SOURCES AND NOT TARGET GTest::gmock)
  set(INSTALL_GTEST OFF)
  set(BUILD_SHARED_LIBS OFF)  # each DLL would have the compiler's libraries in it
  if(CMAKE_SYSTEM_NAME STREQUAL "WASI")
    set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)  # so that the next line sets its option
    set(gtest_disable_pthreads ON)
  endif()
  add_subdirectory(${SHAFTCULL_GOOGLETEST_SOURCES} ${CMAKE_BINARY_DIR}/googletest EXCLUDE_FROM_ALL)
  if(CMAKE_SYSTEM_NAME STREQUAL "WASI")  # which has neither exceptions nor dup()
    set_target_properties(gtest gmock PROPERTIES COMPILE_FLAGS "")
    target_compile_definitions(gtest PUBLIC GTEST_HAS_STREAM_REDIRECTION=0)
  endif()
endif()
if(TARGET GTest::gmock)
  set(GTest_FOUND TRUE)
endif()
