# SPDX-License-Identifier: MIT
# What is true of the build itself: symbols of each instruction set, exports, the installed package, headers. Included by CMakeLists.txt.

set(isas_with_flags ${isas})
list(REMOVE_ITEM isas_with_flags scalar portable128 neon)
foreach(isa IN LISTS isas_with_flags)
  add_test(NAME symbols.${isa}
    COMMAND ${CMAKE_COMMAND} -D NM=${CMAKE_NM} "-DOBJECTS=$<TARGET_OBJECTS:shaftcull_${isa}>" -D ISA=${isa}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/symbols.cmake)
endforeach()
if(NOT CMAKE_CROSSCOMPILING)
  add_test(NAME exports
    COMMAND ${CMAKE_COMMAND} -D NM=${CMAKE_NM} -D LIBRARY=$<TARGET_FILE:shaftcull> -D INCLUDE=${PROJECT_SOURCE_DIR}/include
            -P ${CMAKE_CURRENT_SOURCE_DIR}/exports.cmake)
endif()
# In release builds by g++ only: a loop that is not unrolled has one instruction for many lines.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize"
   AND CMAKE_OBJDUMP AND CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_test(NAME fetches
    COMMAND ${CMAKE_COMMAND} -D OBJDUMP=${CMAKE_OBJDUMP} "-DOBJECTS=$<TARGET_OBJECTS:shaftcull>"
            -P ${CMAKE_CURRENT_SOURCE_DIR}/fetches.cmake)
endif()
if(SHAFTCULL_INSTALL AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  add_test(NAME consumer
    COMMAND ${CMAKE_COMMAND} -D BUILD=${PROJECT_BINARY_DIR} -D WORK=${CMAKE_CURRENT_BINARY_DIR}/consumer
            -D CONFIG=$<CONFIG> -D GENERATOR=${CMAKE_GENERATOR} -D COMPILER=${CMAKE_CXX_COMPILER}
            "-DFLAGS=${CMAKE_CXX_FLAGS}" -D TOOLCHAIN=${CMAKE_TOOLCHAIN_FILE} -D EMULATOR=${shaftcull_emulator}
            -D SUFFIX=${CMAKE_EXECUTABLE_SUFFIX} -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/check.cmake)
endif()

# Every public header compiles by itself.
file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR}/include CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/shaftcull/*.hpp)
set(header_units "")
foreach(header IN LISTS headers)
  set(unit ${CMAKE_CURRENT_BINARY_DIR}/headers/${header}.cpp)
  file(CONFIGURE OUTPUT ${unit} CONTENT "#include \"@header@\"\n#include \"@header@\"\n" @ONLY)
  list(APPEND header_units ${unit})
endforeach()
add_library(shaftcull_headers OBJECT ${header_units})
target_link_libraries(shaftcull_headers PRIVATE shaftcull::shaftcull)
shaftcull_warnings(shaftcull_headers)
if(quick_tests)  # where the layers run most of what there is
  add_dependencies(shaftcull_ci_tests shaftcull_headers)
endif()
