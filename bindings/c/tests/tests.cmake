# SPDX-License-Identifier: MIT
# Tests of the C interface, the area `c`. Included by tests/CMakeLists.txt.

set(c_tests ${PROJECT_SOURCE_DIR}/bindings/c/tests)

# Every question, against the C++ interface; and what holds of all calls.
shaftcull_test(c
  ${c_tests}/agreement.cpp
  ${c_tests}/agreement_questions.cpp
  ${c_tests}/agreement_shafts.cpp
  ${c_tests}/structs.cpp)
target_link_libraries(test_c PRIVATE shaftcull_c)
target_include_directories(test_c PRIVATE ${c_tests} ${PROJECT_SOURCE_DIR}/bindings/c)
if(shaftcull_wasm)  # where errors are no statuses; the npm package tests them
  return()
endif()
target_sources(test_c PRIVATE ${c_tests}/errors.cpp ${c_tests}/view_factors.cpp ${c_tests}/visibility.cpp)

# It replaces operator new, so it is a program of its own.
shaftcull_test(c_memory
  ${c_tests}/memory.cpp
  failing_memory.cpp)
target_link_libraries(test_c_memory PRIVATE shaftcull_c)
target_include_directories(test_c_memory PRIVATE ${c_tests})

# shaftcull_c_program(NAME COMPILER SOURCE): the program test_c_NAME, compiled as C11 with warnings as errors, and the CTest entry
# c.NAME. Compilers are called as they are: the project itself is one of C++, and both compilers shall see the header.
function(shaftcull_c_program name compiler source)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/c/${name}.o)
  set(flags -std=c11 -O1 -Wall -Wextra -Wpedantic -Werror -I${PROJECT_SOURCE_DIR}/include)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    list(APPEND flags -DSHAFTCULL_SANITIZED)
  endif()
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/c)
  add_custom_command(OUTPUT ${object}
    COMMAND ${compiler} ${flags} -c ${source} -o ${object}
    DEPENDS ${source} ${PROJECT_SOURCE_DIR}/include/shaftcull.h VERBATIM)
  add_executable(test_c_${name} ${object})
  set_target_properties(test_c_${name} PROPERTIES
    LINKER_LANGUAGE CXX RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  target_link_libraries(test_c_${name} PRIVATE shaftcull_c)
  add_dependencies(test_c test_c_${name})  # so that whoever builds the area has all of it
  add_test(NAME c.${name} COMMAND test_c_${name})
  set_tests_properties(c.${name} PROPERTIES TIMEOUT ${shaftcull_test_seconds})
endfunction()

# Every function and every kind of error, from C by two compilers; and the example of the page, as it stands there.
set(c_compiler_names "")
set(c_compilers gcc clang)
if(CMAKE_CROSSCOMPILING)  # those that are called so compile for this machine
  set(c_compilers gcc)
  set(SHAFTCULL_C_gcc ${CMAKE_C_COMPILER} CACHE FILEPATH "The toolchain's compiler of C")
endif()
foreach(name IN LISTS c_compilers)
  find_program(SHAFTCULL_C_${name} ${name})
  mark_as_advanced(SHAFTCULL_C_${name})
  if(SHAFTCULL_C_${name})
    shaftcull_c_program(${name} ${SHAFTCULL_C_${name}} ${c_tests}/every_function.c)
    list(APPEND c_compiler_names ${name})
  else()
    message(STATUS "No test c.${name}: there is no ${name} on this machine")
  endif()
endforeach()
if(c_compiler_names)
  list(GET c_compiler_names 0 name)
  set(page ${PROJECT_SOURCE_DIR}/docs/c.md)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
  # A line of the page that is indented by four is one of code; the example begins with an #include and ends with a brace.
  file(READ ${page} text)
  if(NOT text MATCHES "\n    (#include[^`]*\n    })\n")
    message(FATAL_ERROR "${page} has no example of C")
  endif()
  string(REPLACE "\n    " "\n" example "${CMAKE_MATCH_1}\n")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/c/example.c CONTENT "${example}" @ONLY)
  shaftcull_c_program(example ${SHAFTCULL_C_${name}} ${CMAKE_CURRENT_BINARY_DIR}/c/example.c)
  set_tests_properties(c.example PROPERTIES PASS_REGULAR_EXPRESSION "^box 0 may, box 1 cannot\r?\n$")
endif()

# The header: what it declares is documented, defined, exported, and called by the program above.
add_test(NAME c.symbols
  COMMAND ${CMAKE_COMMAND} -D NM=${CMAKE_NM} -D LIBRARY=$<TARGET_FILE:shaftcull_c>
          -D SHARED=$<STREQUAL:$<TARGET_PROPERTY:shaftcull_c,TYPE>,SHARED_LIBRARY>
          -D HEADER=${PROJECT_SOURCE_DIR}/include/shaftcull.h -D RECORD=${c_tests}/symbols.txt
          -P ${c_tests}/symbols.cmake)
add_test(NAME c.header
  COMMAND ${CMAKE_COMMAND} -D HEADER=${PROJECT_SOURCE_DIR}/include/shaftcull.h -D RECORD=${c_tests}/symbols.txt
          -D PROGRAM=${c_tests}/every_function.c -D QUESTIONS=${PROJECT_SOURCE_DIR}/docs/questions.md -P ${c_tests}/header.cmake)
