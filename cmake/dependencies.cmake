# The libraries that this project needs, found once for all folders.
include(${CMAKE_CURRENT_LIST_DIR}/dependency.cmake)

shaftcull_dependency(xsimd TARGET xsimd VERSION 8.1 DEBIAN libxsimd-dev NEEDED_BY "The library")
if(SHAFTCULL_WITH_TBB)
  shaftcull_dependency(TBB TARGET TBB::tbb DEBIAN libtbb-dev
    NEEDED_BY "With SHAFTCULL_WITH_TBB=ON the library")
endif()
if(SHAFTCULL_BUILD_BENCH)
  shaftcull_dependency(benchmark TARGET benchmark::benchmark DEBIAN libbenchmark-dev NEEDED_BY "The benchmark")
  shaftcull_dependency(CLI11 TARGET CLI11::CLI11 DEBIAN libcli11-dev NEEDED_BY "The program shaftcull")
  shaftcull_dependency(nlohmann_json TARGET nlohmann_json::nlohmann_json DEBIAN nlohmann-json3-dev
    NEEDED_BY "The program shaftcull")
  shaftcull_dependency(fmt TARGET fmt::fmt DEBIAN libfmt-dev NEEDED_BY "The program shaftcull")
  if(SHAFTCULL_WITH_ASSIMP)
    shaftcull_dependency(assimp TARGET assimp::assimp DEBIAN libassimp-dev zlib1g-dev
      WITHOUT "The program shaftcull is built without its mesh reader, so its subcommand `cull` reads no file")
  endif()
endif()
if(SHAFTCULL_BUILD_TESTS)
  shaftcull_dependency(GTest TARGET GTest::gmock DEBIAN libgtest-dev libgmock-dev NEEDED_BY "The tests")
  shaftcull_dependency(GMP TARGET GMP::gmpxx DEBIAN libgmp-dev NEEDED_BY "The tests")
elseif(SHAFTCULL_BUILD_BENCH)
  shaftcull_dependency(GMP TARGET GMP::gmpxx DEBIAN libgmp-dev
    WITHOUT "The program shaftcull is built without its subcommand `verify`")
endif()
