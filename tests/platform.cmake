# SPDX-License-Identifier: MIT
# The system and the processor that tests run on, and the tests that are left out there. Included by CMakeLists.txt.

# Built for another processor or system, programs are run by an emulator: by CTest itself where a test's command is a target, and
# else by this in front of the program's file.
set(shaftcull_emulator ${CMAKE_CROSSCOMPILING_EMULATOR})
# Another processor is emulated, which takes ten to twenty times as long. So all is run on the best instruction set, and on the
# lesser ones what shows that they compute the same. Programs of Windows and WebAssembly run on the processor itself.
# WebAssembly has no exceptions, threads, processes or protected memory.
set(shaftcull_wasm FALSE)
if(CMAKE_SYSTEM_NAME STREQUAL "WASI")
  set(shaftcull_wasm TRUE)
endif()
set(shaftcull_emulates_processor FALSE)
if(shaftcull_emulator AND NOT WIN32 AND NOT shaftcull_wasm)
  set(shaftcull_emulates_processor TRUE)
endif()
set(shaftcull_system posix)  # of which there are sources named so, where systems differ
if(WIN32)
  set(shaftcull_system windows)
endif()

# Debian's Python has Debian's packages, whichever Python comes first in the PATH.
find_program(SHAFTCULL_SYSTEM_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(SHAFTCULL_SYSTEM_PYTHON python3)
mark_as_advanced(SHAFTCULL_SYSTEM_PYTHON)

# The best instruction set of this machine, as far as the build has it. An emulator has them all.
list(GET isas -1 shaftcull_best_set)
if("avx512" IN_LIST isas AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  include(${PROJECT_SOURCE_DIR}/cmake/machine.cmake)
  if(shaftcull_set_of_machine)
    set(shaftcull_best_set ${shaftcull_set_of_machine})
  endif()
endif()

set(shaftcull_test_seconds 900)
set(shaftcull_long_areas allocation calls many many_tree options tree tree_building)
set(shaftcull_test_environment "")
if(shaftcull_emulates_processor)
  set(shaftcull_test_seconds 7200)
  set(shaftcull_test_environment SHAFTCULL_EXPECTED_ISA=${shaftcull_best_set})
endif()
if(WIN32)
  message(STATUS "Tests that are left out on Windows:\n"
    "     sources.cmake (documents, packages, format of sources): they are the same for every system\n"
    "     emulated, embedding, budget: they are of Linux\n"
    "     Stack, of calls: no thread can be given a stack that was painted before\n"
    "     ForkedChild, of calls: there is no fork()\n"
    "     wide: pages that nobody wrote to are not all the same one\n"
    "     interrupted_program, output and sees_posix, of cli: NumPy, devices and signals of POSIX\n"
    "     c.clang: C is compiled by the toolchain's own compiler")
elseif(shaftcull_wasm)
  message(STATUS "Tests that are left out in WebAssembly:\n"
    "     sources.cmake (documents, packages, format of sources): they are the same for every processor\n"
    "     emulated, embedding, budget: they are of Linux\n"
    "     cli, hash, batch, bench: the program is not built. The npm package and the page have hashes, too\n"
    "     what callbacks throw; fuzz_corpus: there are no exceptions\n"
    "     what threads do: there is one\n"
    "     float modes and locales: there is one of each\n"
    "     memory that runs out, of allocation and others: the program ends there\n"
    "     isa: tests of it end programs\n"
    "     wide: a program has four gigabytes\n"
    "     errors of the C interface, and what sees what in C: the npm package tests them\n"
    "     consumer: nothing is installed\n"
    "     Reads behind the end of an array are not noticed, for no memory can be protected")
elseif(CMAKE_CROSSCOMPILING)
  message(STATUS "Tests that are left out, for programs are built for another processor than this machine's:\n"
    "     sources.cmake (documents, packages, format of sources): they are the same for every processor\n"
    "     emulated (tests/emulated.cmake): these processors are of x86\n"
    "     embedding: those builds are for this machine\n"
    "     budget: valgrind runs programs of this machine\n"
    "     fetches: it reads instructions of x86\n"
    "     lesser instruction sets, but for simd and same_bits: for time\n"
    "     wide: an emulator takes many minutes for more than 2^32 bounds\n"
    "     python, batch, and cli of mesh files: NumPy, HDF5 and assimp of the other processor are not asked for\n"
    "     c.clang: C is compiled by the toolchain's own compiler")
endif()
if(CMAKE_CROSSCOMPILING AND NOT shaftcull_emulator)
  message(STATUS "CMAKE_CROSSCOMPILING_EMULATOR is not set: no test that is built runs here")
endif()
