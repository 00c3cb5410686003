# SPDX-License-Identifier: MIT
# Finds xxHash: the target xxHash::xxHash.
include(FindPackageHandleStandardArgs)
include(${CMAKE_CURRENT_LIST_DIR}/header_version.cmake)

find_path(XXHASH_INCLUDE_DIR xxhash.h)
find_library(XXHASH_LIBRARY xxhash)
mark_as_advanced(XXHASH_INCLUDE_DIR XXHASH_LIBRARY)
set(xxHash_VERSION "")
if(XXHASH_INCLUDE_DIR)
  shaftcull_header_version(xxHash_VERSION ${XXHASH_INCLUDE_DIR}/xxhash.h XXH_VERSION MAJOR MINOR RELEASE)
endif()
find_package_handle_standard_args(xxHash REQUIRED_VARS XXHASH_LIBRARY XXHASH_INCLUDE_DIR VERSION_VAR xxHash_VERSION)
if(xxHash_FOUND AND NOT TARGET xxHash::xxHash)
  add_library(xxHash::xxHash UNKNOWN IMPORTED)
  set_target_properties(xxHash::xxHash PROPERTIES
    IMPORTED_LOCATION ${XXHASH_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${XXHASH_INCLUDE_DIR})
endif()
