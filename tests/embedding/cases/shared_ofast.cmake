# SPDX-License-Identifier: MIT
# A shared library, of which the interface is all that is to be seen. -Ofast for everything, linking included: that adds code
# which sets the processor to flush denormal numbers to zero.
needs(g++)
configure(g++ -D BUILD_SHARED_LIBS=ON -D SHAFTCULL_BUILD_C=ON -D PARENT_OPTIONS=-Ofast)
build()
answers()
run(${CMAKE_COMMAND} -D NM=nm -D "LIBRARY=${WORK}/a parent/third_party/shaftcull/kernel/libshaftcull.so"
  -D INCLUDE=${SHAFTCULL}/include -P ${SHAFTCULL}/tests/exports.cmake)

# The C interface exports its functions, and none of the C++ one.
run(${CMAKE_COMMAND} -D NM=nm -D SHARED=1 "-DLIBRARY=${WORK}/a parent/third_party/shaftcull/bindings/c/libshaftcull_c.so"
  -D RECORD=${SHAFTCULL}/bindings/c/tests/symbols.txt -P ${SHAFTCULL}/bindings/c/tests/symbols.cmake)
