# SPDX-License-Identifier: MIT
# -march=native: instruction sets that are part of what every function may use anyway are left out, but for the best of them.
# And the static library in somebody's exported library, and in two plugins of one program.
needs(g++ -march=native)
configure(g++ -D "PARENT_OPTIONS=-O0 -march=native"
  -D PARENT_MORE=${CMAKE_CURRENT_LIST_DIR}/../parent/more.cmake)
build()
if(shaftcull_set_of_machine STREQUAL "avx512")
  answers("scalar: as on record\navx512: as on record\n")
else()
  answers()
endif()
run("${WORK}/a parent/host" "${WORK}/a parent/first.so" "${WORK}/a parent/second.so")

run(${CMAKE_COMMAND} --install "${WORK}/a parent" --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../package -B ${WORK}/user -G ${GENERATOR} -D CMAKE_CXX_COMPILER=g++
  -D CMAKE_PREFIX_PATH=${WORK}/prefix -D CLIENT=${client} -D LIBRARY=scene)
run(${CMAKE_COMMAND} --build ${WORK}/user)
run(${WORK}/user/client)
