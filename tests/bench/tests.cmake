# SPDX-License-Identifier: MIT
# Tests of the benchmarks: their scenes, and what they compare the library with.

shaftcull_test(bench
  bench/pairs.cpp
  bench/scenes.cpp)
target_link_libraries(test_bench PRIVATE shaftcull_scenes)
if(embree_FOUND)
  target_sources(test_bench PRIVATE bench/embree.cpp ${PROJECT_SOURCE_DIR}/bench/peers/embree.cpp)
  target_link_libraries(test_bench PRIVATE embree)
endif()
