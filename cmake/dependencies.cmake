# SPDX-License-Identifier: MIT
# The libraries that this project needs, found once for all folders.
include(${CMAKE_CURRENT_LIST_DIR}/dependency.cmake)

# Instruction sets of their own have 64-bit x86 and 64-bit ARM (little-endian), by g++ and clang; other builds have the portable sets
# alone. Only those of x86 need xsimd.
set(shaftcull_is_x86 FALSE)
set(shaftcull_is_arm FALSE)
if(CMAKE_SIZEOF_VOID_P EQUAL 8 AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    set(shaftcull_is_x86 TRUE)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$")
    set(shaftcull_is_arm TRUE)
  endif()
endif()

if(shaftcull_is_x86)
  shaftcull_dependency(xsimd TARGET xsimd VERSION 8.1 DEBIAN libxsimd-dev
    NEEDED_BY "On 64-bit x86 the library")
  # Where xsimd is in a system's folder, such as /usr/include, that folder would come before a cross compiler's own: so the
  # include path names one that holds xsimd and nothing else.
  set(shaftcull_xsimd_include $<TARGET_PROPERTY:xsimd,INTERFACE_INCLUDE_DIRECTORIES>)
  get_target_property(shaftcull_xsimd_folders xsimd INTERFACE_INCLUDE_DIRECTORIES)
  foreach(folder IN LISTS shaftcull_xsimd_folders)
    if(EXISTS ${folder}/xsimd/xsimd.hpp)
      set(shaftcull_xsimd_include ${PROJECT_BINARY_DIR}/xsimd)
      file(MAKE_DIRECTORY ${shaftcull_xsimd_include})
      file(CREATE_LINK ${folder}/xsimd ${shaftcull_xsimd_include}/xsimd SYMBOLIC COPY_ON_ERROR)
      break()
    endif()
  endforeach()
endif()
if(SHAFTCULL_WITH_TBB)
  shaftcull_dependency(TBB TARGET TBB::tbb DEBIAN libtbb-dev
    NEEDED_BY "With SHAFTCULL_WITH_TBB=ON the library")
endif()
if(SHAFTCULL_BUILD_BENCH)
  if(WIN32)  # for which Debian has none
    find_package(benchmark QUIET)
    if(NOT benchmark_FOUND)
      message(STATUS "The benchmark is not built: Google Benchmark was not found.")
    endif()
  else()
    shaftcull_dependency(benchmark TARGET benchmark::benchmark DEBIAN libbenchmark-dev NEEDED_BY "The benchmark")
  endif()
  shaftcull_dependency(CLI11 TARGET CLI11::CLI11 DEBIAN libcli11-dev NEEDED_BY "The program shaftcull")
  shaftcull_dependency(nlohmann_json TARGET nlohmann_json::nlohmann_json DEBIAN nlohmann-json3-dev
    NEEDED_BY "The program shaftcull")
  shaftcull_dependency(fmt TARGET fmt::fmt DEBIAN libfmt-dev NEEDED_BY "The program shaftcull")
  shaftcull_dependency(ZLIB TARGET ZLIB::ZLIB DEBIAN zlib1g-dev NEEDED_BY "The program shaftcull")
  find_package(embree 3 QUIET)
  if(NOT embree_FOUND)
    message(STATUS "The benchmark sees/… has no peer: Embree 3 was not found (Debian: libembree-dev).")
  endif()
  if(SHAFTCULL_WITH_ASSIMP)
    shaftcull_dependency(assimp TARGET assimp::assimp DEBIAN libassimp-dev
      WITHOUT "The program shaftcull is built without its mesh reader, so its subcommand `cull` reads no file")
  endif()
  # For the subcommand `batch`. Nobody else misses them, so configuring goes on without a warning.
  set(shaftcull_has_batch FALSE)
  if(SHAFTCULL_WITH_MPI)
    set(MPI_CXX_SKIP_MPICXX TRUE)  # its own interface for C++, which newer ones have no more
    find_package(MPI QUIET COMPONENTS CXX)
  endif()
  if(SHAFTCULL_WITH_HDF5)
    find_package(HDF5 1.10.5 QUIET)
    find_package(xxHash 0.8 QUIET)
    find_package(Threads QUIET)
    if(HDF5_FOUND AND xxHash_FOUND AND Threads_FOUND)
      set(shaftcull_has_batch TRUE)
    endif()
  endif()
  if(NOT shaftcull_has_batch)
    message(STATUS "The program shaftcull is built without its subcommand `batch`: it needs HDF5 1.10.5 and xxHash 0.8 "
                   "(Debian: libhdf5-dev or libhdf5-openmpi-dev, and libxxhash-dev).")
  elseif(NOT MPI_CXX_FOUND)
    message(STATUS "The subcommand `batch` of shaftcull runs in one process: MPI was not found (Debian: libopenmpi-dev).")
  endif()
endif()
# Rationals of the tests. On Windows GMP is rare, so Boost's integers will do (tests/oracle/boost/gmpxx.h).
if(WIN32 AND SHAFTCULL_BUILD_TESTS)
  find_package(GMP QUIET)
endif()
if(SHAFTCULL_BUILD_TESTS)
  shaftcull_dependency(GTest TARGET GTest::gmock DEBIAN libgtest-dev libgmock-dev NEEDED_BY "The tests")
endif()
if(SHAFTCULL_BUILD_TESTS AND WIN32 AND NOT GMP_FOUND)
  shaftcull_dependency(Boost TARGET Boost::headers DEBIAN libboost-dev NEEDED_BY "Without GMP, the tests")
elseif(SHAFTCULL_BUILD_TESTS)
  shaftcull_dependency(GMP TARGET GMP::gmpxx DEBIAN libgmp-dev NEEDED_BY "The tests")
elseif(SHAFTCULL_BUILD_BENCH)
  shaftcull_dependency(GMP TARGET GMP::gmpxx DEBIAN libgmp-dev
    WITHOUT "The program shaftcull is built without its subcommand `verify`")
endif()
