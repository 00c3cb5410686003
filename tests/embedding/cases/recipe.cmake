# SPDX-License-Identifier: MIT
# The CMakeLists.txt of docs/recipes/index.md builds recipes on the installed package: a single source, one that includes a header,
# and one with threads of its own.
needs(g++)
set(prefix "${WORK}/a prefix")
foreach(component IN ITEMS shaftcull_runtime shaftcull_development)
  run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix "${prefix}")
endforeach()

file(READ ${SHAFTCULL}/docs/recipes/index.md page)
if(NOT page MATCHES "\n```cmake\n([^`]+)```\n")
  message(FATAL_ERROR "docs/recipes/index.md shows no CMakeLists.txt")
endif()
file(WRITE ${WORK}/project/CMakeLists.txt "${CMAKE_MATCH_1}")
set(examples ${SHAFTCULL}/docs/examples)
file(GLOB headers ${examples}/*.hpp)
file(COPY ${headers} DESTINATION ${WORK}/project)

foreach(recipe IN ITEMS thermal_model moved_occluder own_threads)
  configure_file(${examples}/${recipe}.cpp ${WORK}/project/main.cpp COPYONLY)
  run(${CMAKE_COMMAND} -S ${WORK}/project -B ${WORK}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=g++
    -D CMAKE_BUILD_TYPE=Release -D "CMAKE_PREFIX_PATH=${prefix}")
  run(${CMAKE_COMMAND} --build ${WORK}/build)
  run(${WORK}/build/recipe)
endforeach()
