# SPDX-License-Identifier: MIT
# Rays through large groups of triangles by Embree: in a project that has the library in a folder, and in one that has it installed.
needs(g++)
file(WRITE ${WORK}/probe.cpp "#include <embree3/rtcore.h>\nint main() { rtcReleaseDevice(rtcNewDevice(nullptr)); }\n")
execute_process(COMMAND g++ probe.cpp -lembree3 -o probe WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(NOT result EQUAL 0)
  skip("there is no Embree 3 on this machine")
endif()
set(rays ${CMAKE_CURRENT_LIST_DIR}/../rays.cpp)
configure(g++ -D SHAFTCULL_WITH_EMBREE=ON -D SHAFTCULL_BUILD_C=ON -D SHAFTCULL_INSTRUCTION_SETS=BEST -D "PARENT_OPTIONS=-O1 -Wall -Wextra"
  -D CLIENT=${rays})
build()
answers("rays: as expected\n")

set(prefix "${WORK}/a prefix")
run(${CMAKE_COMMAND} --install "${WORK}/a parent" --prefix "${prefix}")
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../package -B ${WORK}/user -G ${GENERATOR} -D CMAKE_CXX_COMPILER=g++
  -D "CMAKE_PREFIX_PATH=${prefix}" -D CLIENT=${rays} -D LIBRARY=shaftcull)
run(${CMAKE_COMMAND} --build ${WORK}/user)
run(${WORK}/user/client)

use_pkg_config("${prefix}")
run_by_pkg_config(shaftcull g++ -std=c++20 ${rays})
run_by_pkg_config(shaftcull_c gcc -std=c11 ${SHAFTCULL}/tests/consumer/main.c)
