# SPDX-License-Identifier: MIT
# Every operation of every instruction set, against a plain definition. Operations are compiled as the library's kernels are.
shaftcull_test(simd EVERY_ISA
  simd/eight_floats.cpp
  simd/floats.cpp
  simd/integers16.cpp)
target_include_directories(test_simd PRIVATE $<TARGET_PROPERTY:shaftcull,BINARY_DIR>)  # for the list of sets
foreach(isa IN LISTS isas)
  file(GLOB_RECURSE header RELATIVE ${PROJECT_SOURCE_DIR}/kernel ${PROJECT_SOURCE_DIR}/kernel/simd/${isa}.hpp)
  add_library(shaftcull_simd_${isa} OBJECT simd/set.cpp)
  foreach(property IN ITEMS COMPILE_FEATURES COMPILE_OPTIONS INCLUDE_DIRECTORIES CXX_EXTENSIONS)
    set_property(TARGET shaftcull_simd_${isa} PROPERTY ${property} $<TARGET_PROPERTY:shaftcull_${isa},${property}>)
  endforeach()
  target_include_directories(shaftcull_simd_${isa} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_include_directories(shaftcull_simd_${isa} SYSTEM PRIVATE ${shaftcull_xsimd_include})
  target_compile_definitions(shaftcull_simd_${isa} PRIVATE SHAFTCULL_SET=${isa} SHAFTCULL_SET_HEADER="${header}")
  target_sources(test_simd PRIVATE $<TARGET_OBJECTS:shaftcull_simd_${isa}>)
endforeach()
