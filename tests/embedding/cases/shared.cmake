# A shared library, of which the interface is all that is to be seen.
needs(g++)
configure(g++ -D BUILD_SHARED_LIBS=ON -D PARENT_OPTIONS=-O1)
build()
answers()
run(${CMAKE_COMMAND} -D NM=nm -D "LIBRARY=${WORK}/a parent/third_party/shaftcull/kernel/libshaftcull.so"
  -D INCLUDE=${SHAFTCULL}/include -P ${SHAFTCULL}/tests/exports.cmake)
