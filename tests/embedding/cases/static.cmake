# The static library in somebody's exported library, and in two plugins of one program.
needs(g++)
configure(g++ -D PARENT_OPTIONS=-O0 -D SHAFTCULL_JOIN_SOURCES=OFF -D PARENT_MORE=${CMAKE_CURRENT_LIST_DIR}/../parent/more.cmake)
build()
run("${WORK}/a parent/host" "${WORK}/a parent/first.so" "${WORK}/a parent/second.so")

run(${CMAKE_COMMAND} --install "${WORK}/a parent" --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../package -B ${WORK}/user -G ${GENERATOR} -D CMAKE_CXX_COMPILER=g++
  -D CMAKE_PREFIX_PATH=${WORK}/prefix -D CLIENT=${client} -D LIBRARY=scene)
run(${CMAKE_COMMAND} --build ${WORK}/user)
run(${WORK}/user/client)
