# SPDX-License-Identifier: MIT
# Installs these components, whose names do not meet those of a parent project; docs/packages.md says what each holds.
#   shaftcull_runtime      what programs need that are linked already: shared libraries
#   shaftcull_development  headers, static libraries or links to the shared ones, the CMake package that find_package(shaftcull)
#                          finds, and the files that pkg-config reads
#   shaftcull_program      the program and its manual page, where it is built
#   shaftcull_python       the Python package, where it is built (bindings/python/CMakeLists.txt)
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(shaftcull_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/shaftcull)
set(shaftcull_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Only a static library makes its user link oneTBB and Embree.
set(shaftcull_package_needs_tbb FALSE)
set(shaftcull_package_needs_embree FALSE)
set(shaftcull_pc_requires "")
set(shaftcull_pc_libraries "")
set(shaftcull_pc_definitions "")
get_target_property(shaftcull_type shaftcull TYPE)
if(shaftcull_type STREQUAL "SHARED_LIBRARY")
  set(shaftcull_pc_definitions " -DSHAFTCULL_SHARED")
else()
  if(SHAFTCULL_WITH_TBB)
    set(shaftcull_package_needs_tbb TRUE)
    set(shaftcull_pc_requires tbb)
  endif()
  if(SHAFTCULL_WITH_EMBREE)
    set(shaftcull_package_needs_embree TRUE)
    set(shaftcull_pc_libraries " -lembree3")  # which has no file for pkg-config
  endif()
endif()

set(shaftcull_libraries shaftcull)
set(shaftcull_components cpp)  # of find_package(shaftcull COMPONENTS …)
if(TARGET shaftcull_c)
  list(APPEND shaftcull_libraries shaftcull_c)
  list(APPEND shaftcull_components c)
endif()
install(TARGETS ${shaftcull_libraries} EXPORT shaftcull
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT shaftcull_development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT shaftcull_runtime NAMELINK_COMPONENT shaftcull_development
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT shaftcull_runtime
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET shaftcull_c)
  install(FILES ${PROJECT_SOURCE_DIR}/include/shaftcull.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    COMPONENT shaftcull_development)
  if(shaftcull_type STREQUAL "SHARED_LIBRARY" AND NOT WIN32)
    set_target_properties(shaftcull_c PROPERTIES INSTALL_RPATH "$ORIGIN")  # the C++ library lies beside it
  endif()
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/shaftcull
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT shaftcull_development)

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/shaftcull-config.cmake.in ${PROJECT_BINARY_DIR}/shaftcull-config.cmake
  INSTALL_DESTINATION ${shaftcull_package_dir}
  NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/shaftcull-config-version.cmake
  COMPATIBILITY SameMajorVersion)
install(EXPORT shaftcull
  FILE shaftcull-targets.cmake
  NAMESPACE shaftcull::
  DESTINATION ${shaftcull_package_dir}
  COMPONENT shaftcull_development)
install(FILES ${PROJECT_BINARY_DIR}/shaftcull-config.cmake ${PROJECT_BINARY_DIR}/shaftcull-config-version.cmake
  DESTINATION ${shaftcull_package_dir}
  COMPONENT shaftcull_development)

# pkg-config says where it found its file, from which the prefix follows: what is installed can be moved.
file(RELATIVE_PATH shaftcull_prefix_from_pc /${shaftcull_pc_dir} /)
string(REGEX REPLACE "/$" "" shaftcull_prefix_from_pc "${shaftcull_prefix_from_pc}")
configure_file(${CMAKE_CURRENT_LIST_DIR}/shaftcull.pc.in ${PROJECT_BINARY_DIR}/shaftcull.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/shaftcull.pc DESTINATION ${shaftcull_pc_dir} COMPONENT shaftcull_development)

# A shared C interface finds the C++ library itself. A static one needs all that is linked into neither.
if(TARGET shaftcull_c)
  set(shaftcull_c_pc_libraries "")
  if(NOT shaftcull_type STREQUAL "SHARED_LIBRARY")
    set(shaftcull_c_cxx ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
    list(FILTER shaftcull_c_cxx INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|m)$")
    list(REMOVE_DUPLICATES shaftcull_c_cxx)
    list(TRANSFORM shaftcull_c_cxx PREPEND " -l")
    list(JOIN shaftcull_c_cxx "" shaftcull_c_pc_libraries)
    string(PREPEND shaftcull_c_pc_libraries " -lshaftcull${shaftcull_pc_libraries}")
  endif()
  configure_file(${CMAKE_CURRENT_LIST_DIR}/shaftcull_c.pc.in ${PROJECT_BINARY_DIR}/shaftcull_c.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/shaftcull_c.pc DESTINATION ${shaftcull_pc_dir} COMPONENT shaftcull_development)
endif()

if(TARGET shaftcull_cli)
  if(shaftcull_type STREQUAL "SHARED_LIBRARY")
    file(RELATIVE_PATH shaftcull_lib_from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
    set_target_properties(shaftcull_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${shaftcull_lib_from_bin}")
  endif()
  install(TARGETS shaftcull_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT shaftcull_program)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/shaftcull.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT shaftcull_program)
endif()

# Where the library is shared, Debian's packages can be made of these components.
include(${CMAKE_CURRENT_LIST_DIR}/packaging/debian.cmake)
