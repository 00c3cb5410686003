# SPDX-License-Identifier: MIT
# Finds the C library of HDF5, for C++ alone: the target HDF5::HDF5. CMake's own module asks for a C compiler.
#
# Of several builds, as Debian has them beside each other, one without MPI is taken first: files are written without its help.
# A build with MPI is taken where MPI itself was found, for its headers name those of MPI.
include(FindPackageHandleStandardArgs)
include(${CMAKE_CURRENT_LIST_DIR}/header_version.cmake)

find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial hdf5 hdf5/openmpi hdf5/mpich)
find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5 hdf5_openmpi hdf5_mpich NAMES_PER_DIR)
mark_as_advanced(HDF5_INCLUDE_DIR HDF5_LIBRARY)

set(HDF5_VERSION "")
set(HDF5_IS_PARALLEL FALSE)
set(shaftcull_hdf5_usable FALSE)
if(HDF5_INCLUDE_DIR)
  shaftcull_header_version(HDF5_VERSION ${HDF5_INCLUDE_DIR}/H5public.h H5_VERS MAJOR MINOR RELEASE)
  file(GLOB headers ${HDF5_INCLUDE_DIR}/H5pubconf*.h)
  set(parallel "")
  foreach(header IN LISTS headers)
    file(STRINGS ${header} line REGEX "^#define H5_HAVE_PARALLEL 1" LIMIT_COUNT 1)
    list(APPEND parallel ${line})
  endforeach()
  if(parallel)
    set(HDF5_IS_PARALLEL TRUE)
  endif()
  if(NOT HDF5_IS_PARALLEL OR TARGET MPI::MPI_CXX)
    set(shaftcull_hdf5_usable TRUE)
  endif()
endif()
find_package_handle_standard_args(HDF5
  REQUIRED_VARS HDF5_LIBRARY HDF5_INCLUDE_DIR shaftcull_hdf5_usable VERSION_VAR HDF5_VERSION)
if(HDF5_FOUND AND NOT TARGET HDF5::HDF5)
  add_library(HDF5::HDF5 UNKNOWN IMPORTED)
  set_target_properties(HDF5::HDF5 PROPERTIES
    IMPORTED_LOCATION ${HDF5_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${HDF5_INCLUDE_DIR})
  if(HDF5_IS_PARALLEL)
    set_target_properties(HDF5::HDF5 PROPERTIES INTERFACE_LINK_LIBRARIES MPI::MPI_CXX)
  endif()
endif()
