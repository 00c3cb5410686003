# SPDX-License-Identifier: MIT
# Solids that are found in triangles, against exact arithmetic.
shaftcull_test(solids
  solids/found.cpp
  solids/mesh_occluders.cpp
  solids/open.cpp
  solids/plates.cpp
  solids/proven.cpp)
target_link_libraries(test_solids PRIVATE shaftcull_oracle)
