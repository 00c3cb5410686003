# A shared library, of which the interface is all that is to be seen. -Ofast for everything, linking included: that adds code
# which sets the processor to flush denormal numbers to zero.
needs(g++)
configure(g++ -D BUILD_SHARED_LIBS=ON -D PARENT_OPTIONS=-Ofast)
build()
answers()
run(${CMAKE_COMMAND} -D NM=nm -D "LIBRARY=${WORK}/a parent/third_party/shaftcull/kernel/libshaftcull.so"
  -D INCLUDE=${SHAFTCULL}/include -P ${SHAFTCULL}/tests/exports.cmake)
