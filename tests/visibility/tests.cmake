# SPDX-License-Identifier: MIT
# What sees what, pair by pair, against exact integers.
shaftcull_test(visibility PARTS 2
  visibility/agreement.cpp
  visibility/batches.cpp
  visibility/cones.cpp
  visibility/corners.cpp
  visibility/errors.cpp
  visibility/flush_walls.cpp
  visibility/hulls.cpp
  visibility/lit.cpp
  visibility/meet.cpp
  visibility/parts.cpp
  visibility/patch_tree.cpp
  visibility/ray_trees.cpp
  visibility/rays.cpp
  visibility/reach.cpp
  visibility/rows.cpp
  visibility/siblings.cpp
  visibility/solids.cpp)
target_link_libraries(test_visibility PRIVATE shaftcull_oracle)

# What of them shares work among threads: the rest takes long with ThreadSanitizer, and shows it nothing. One of them has
# tasks of its own, which oneTBB orders unseen.
if(SHAFTCULL_WITH_TBB AND CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")
  add_test(NAME visibility.threads COMMAND test_visibility --gtest_filter=VisibilityBatches.*-*CallsInTasks*)
  set_tests_properties(visibility.threads PROPERTIES TIMEOUT 300)
endif()

if(NOT shaftcull_wasm)
  # It replaces operator new, so it is a program of its own.
  shaftcull_test(visibility_memory
    failing_memory.cpp
    visibility/memory.cpp)
  target_link_libraries(test_visibility_memory PRIVATE shaftcull_oracle)
endif()
