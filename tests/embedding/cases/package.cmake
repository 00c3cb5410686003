# SPDX-License-Identifier: MIT
# What is installed: the CMake package, its version and its components; pkg-config's files; the program and its manual page.
needs(g++)
set(prefix "${WORK}/a prefix")
foreach(component IN ITEMS shaftcull_runtime shaftcull_development shaftcull_program)
  run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix "${prefix}")
endforeach()

file(STRINGS "${prefix}/include/shaftcull/version.hpp" numbers REGEX "^#define SHAFTCULL_VERSION_[A-Z]+ [0-9]+$")
list(TRANSFORM numbers REPLACE "^.* " "")
list(GET numbers 0 major)
list(GET numbers 1 minor)
math(EXPR next_minor "${minor} + 1")
list(JOIN numbers "." version)

set(user ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../package -B ${WORK}/user -G ${GENERATOR} -D CMAKE_CXX_COMPILER=g++
  -D "CMAKE_PREFIX_PATH=${prefix}" -D CLIENT=${client} -D LIBRARY=shaftcull)
fails("compatible with requested version \"${major}.${next_minor}\"" ${user} -D VERSION=${major}.${next_minor})
run(${user} -D VERSION=${major}.${minor})
run(${CMAKE_COMMAND} --build ${WORK}/user)
run(${WORK}/user/client)

# Components of find_package(): one that there is not is an error that names those that there are, or no error if it is
# optional.
set(built "cpp")
if(EXISTS "${prefix}/include/shaftcull.h")
  set(built "cpp and c")
endif()
run(${user} "-DCOMPONENTS=cpp")
run(${user} "-DCOMPONENTS=cpp OPTIONAL_COMPONENTS rust")
if(NOT output MATCHES "found: cpp TRUE, rust FALSE\n")
  message(FATAL_ERROR "an optional component is looked for, and configuring says:\n${output}")
endif()
fails("It was built with the components ${built}, not with rust and ada." ${user} "-DCOMPONENTS=rust cpp ada")

if(EXISTS "${prefix}/bin/shaftcull")  # not where it is not built
  run("${prefix}/bin/shaftcull" --version)
  string(FIND "${output}" "shaftcull ${version} " place)
  if(place EQUAL -1)
    message(FATAL_ERROR "the program's version is ${output}, not ${version}")
  endif()
  if(NOT EXISTS "${prefix}/share/man/man1/shaftcull.1")
    message(FATAL_ERROR "the program is installed without its manual page")
  endif()
endif()

use_pkg_config("${prefix}")
run(${pkg_config} --modversion shaftcull)
if(NOT output STREQUAL "${version}\n")
  message(FATAL_ERROR "pkg-config's version is ${output}, not ${version}")
endif()
run_by_pkg_config(shaftcull g++ -std=c++20 ${client})

# The C interface by its own file, compiled and linked as C.
find_program(c_compiler gcc)
if(c_compiler AND EXISTS "${pc_folder}/shaftcull_c.pc")
  run_by_pkg_config(shaftcull_c ${c_compiler} -std=c11 ${SHAFTCULL}/tests/consumer/main.c)
  if(NOT output STREQUAL "kept 1\n")
    message(FATAL_ERROR "the program in C printed \"${output}\" instead of \"kept 1\"")
  endif()
endif()
