# Installs two components: `shaftcull`, which is the library, its headers, the C interface where it is built, the CMake package
# that find_package(shaftcull) finds and the files that pkg-config reads; and `shaftcull_program`, where it is built.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(shaftcull_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/shaftcull)
set(shaftcull_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Only a static library makes its user link oneTBB.
set(shaftcull_package_needs_tbb FALSE)
set(shaftcull_pc_requires "")
set(shaftcull_pc_definitions "")
get_target_property(shaftcull_type shaftcull TYPE)
if(shaftcull_type STREQUAL "SHARED_LIBRARY")
  set(shaftcull_pc_definitions " -DSHAFTCULL_SHARED")
elseif(SHAFTCULL_WITH_TBB)
  set(shaftcull_package_needs_tbb TRUE)
  set(shaftcull_pc_requires tbb)
endif()

install(TARGETS shaftcull EXPORT shaftcull
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT shaftcull
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT shaftcull
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT shaftcull
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET shaftcull_c)
  install(TARGETS shaftcull_c EXPORT shaftcull
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT shaftcull
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT shaftcull
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT shaftcull
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(FILES ${PROJECT_SOURCE_DIR}/include/shaftcull.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT shaftcull)
  if(shaftcull_type STREQUAL "SHARED_LIBRARY" AND NOT WIN32)
    set_target_properties(shaftcull_c PROPERTIES INSTALL_RPATH "$ORIGIN")  # the C++ library lies beside it
  endif()
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/shaftcull
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT shaftcull)

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/shaftcull-config.cmake.in ${PROJECT_BINARY_DIR}/shaftcull-config.cmake
  INSTALL_DESTINATION ${shaftcull_package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/shaftcull-config-version.cmake
  COMPATIBILITY SameMinorVersion)  # while the major version is 0; see include/shaftcull/version.hpp
install(EXPORT shaftcull
  FILE shaftcull-targets.cmake
  NAMESPACE shaftcull::
  DESTINATION ${shaftcull_package_dir}
  COMPONENT shaftcull)
install(FILES ${PROJECT_BINARY_DIR}/shaftcull-config.cmake ${PROJECT_BINARY_DIR}/shaftcull-config-version.cmake
  DESTINATION ${shaftcull_package_dir}
  COMPONENT shaftcull)

# pkg-config says where it found its file, from which the prefix follows: what is installed can be moved.
file(RELATIVE_PATH shaftcull_prefix_from_pc /${shaftcull_pc_dir} /)
string(REGEX REPLACE "/$" "" shaftcull_prefix_from_pc "${shaftcull_prefix_from_pc}")
configure_file(${CMAKE_CURRENT_LIST_DIR}/shaftcull.pc.in ${PROJECT_BINARY_DIR}/shaftcull.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/shaftcull.pc DESTINATION ${shaftcull_pc_dir} COMPONENT shaftcull)

# A shared C interface finds the C++ library itself. A static one needs all that is linked into neither.
if(TARGET shaftcull_c)
  set(shaftcull_c_pc_libraries "")
  if(NOT shaftcull_type STREQUAL "SHARED_LIBRARY")
    set(shaftcull_c_cxx ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
    list(FILTER shaftcull_c_cxx INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|m)$")
    list(REMOVE_DUPLICATES shaftcull_c_cxx)
    list(TRANSFORM shaftcull_c_cxx PREPEND " -l")
    list(JOIN shaftcull_c_cxx "" shaftcull_c_pc_libraries)
    string(PREPEND shaftcull_c_pc_libraries " -lshaftcull")
  endif()
  configure_file(${CMAKE_CURRENT_LIST_DIR}/shaftcull_c.pc.in ${PROJECT_BINARY_DIR}/shaftcull_c.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/shaftcull_c.pc DESTINATION ${shaftcull_pc_dir} COMPONENT shaftcull)
endif()

if(TARGET shaftcull_cli)
  if(shaftcull_type STREQUAL "SHARED_LIBRARY")
    file(RELATIVE_PATH shaftcull_lib_from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
    set_target_properties(shaftcull_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${shaftcull_lib_from_bin}")
  endif()
  install(TARGETS shaftcull_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT shaftcull_program)
endif()
