# Installs the library and the CMake package that find_package(shaftcull) finds.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/shaftcull)

# Only a static library makes its user link oneTBB.
get_target_property(library_type shaftcull TYPE)
if(SHAFTCULL_WITH_TBB AND library_type STREQUAL "STATIC_LIBRARY")
  set(package_needs_tbb TRUE)
else()
  set(package_needs_tbb FALSE)
endif()

install(TARGETS shaftcull EXPORT shaftcull
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/shaftcull
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT library)

configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/shaftcull-config.cmake.in ${PROJECT_BINARY_DIR}/shaftcull-config.cmake
  INSTALL_DESTINATION ${package_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/shaftcull-config-version.cmake
  COMPATIBILITY SameMajorVersion)
install(EXPORT shaftcull
  FILE shaftcull-targets.cmake
  NAMESPACE shaftcull::
  DESTINATION ${package_dir}
  COMPONENT library)
install(FILES ${PROJECT_BINARY_DIR}/shaftcull-config.cmake ${PROJECT_BINARY_DIR}/shaftcull-config-version.cmake
  DESTINATION ${package_dir}
  COMPONENT library)
