# SPDX-License-Identifier: MIT
# Solids that are found in triangles, against exact arithmetic.
shaftcull_test(solids
  solids/found.cpp
  solids/proven.cpp)
target_link_libraries(test_solids PRIVATE shaftcull_oracle)
