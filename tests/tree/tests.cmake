# SPDX-License-Identifier: MIT
# Bounds trees.

shaftcull_test(tree EVERY_ISA
  tree/agreement.cpp
  tree/any.cpp
  tree/compress_indices.cpp
  tree/errors.cpp
  tree/first_contact.cpp
  tree/frames.cpp
  tree/image.cpp
  tree/layers.cpp
  tree/occluded.cpp
  tree/refine.cpp
  tree/shared_memory.cpp
  tree/sources.cpp
  tree/triangles.cpp)

# How they are built.
shaftcull_test(tree_building EVERY_ISA
  tree/rebuilding.cpp
  tree/regions.cpp
  tree/split.cpp)

# Those that share work among threads.
shaftcull_test(many_tree EVERY_ISA
  tree/many.cpp)
if(NOT shaftcull_wasm)
  target_sources(test_many_tree PRIVATE tree/double_buffer.cpp tree/exceptions.cpp)
endif()

if(NOT shaftcull_wasm)
  # It replaces operator new, so it is a program of its own.
  shaftcull_test(tree_memory
    failing_memory.cpp
    tree/memory.cpp)
endif()
