# SPDX-License-Identifier: MIT
# Tests of the benchmarks: their scenes, and what they compare the library with.

shaftcull_test(bench
  bench/candidate_rays.cpp
  bench/pairs.cpp
  bench/scenes.cpp
  ${PROJECT_SOURCE_DIR}/bench/families/candidate_rays.cpp)
target_link_libraries(test_bench PRIVATE shaftcull_scenes)
foreach(isa IN ITEMS avx2 avx512)
  if(TARGET shaftcull_bench_${isa})
    target_sources(test_bench PRIVATE $<TARGET_OBJECTS:shaftcull_bench_${isa}>)
    string(TOUPPER ${isa} macro)
    target_compile_definitions(test_bench PRIVATE SHAFTCULL_BENCH_WITH_${macro})
  endif()
endforeach()
if(embree_FOUND)
  target_sources(test_bench PRIVATE bench/embree.cpp ${PROJECT_SOURCE_DIR}/bench/peers/embree.cpp)
  target_link_libraries(test_bench PRIVATE embree)
endif()
