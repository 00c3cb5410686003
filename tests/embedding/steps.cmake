# SPDX-License-Identifier: MIT
# What cases do (cases/*.cmake). Given: SHAFTCULL (the sources), BUILD (a build of the same sources), WORK (an empty folder),
# GENERATOR.

set(client ${CMAKE_CURRENT_LIST_DIR}/client.cpp)
set(with_hashes ${CMAKE_CURRENT_LIST_DIR}/parent/hashes.cmake)
# CMake's Release means -O3. At -O1 the compiler takes a third of the time for s390x, and the program of hashes runs as fast. The
# presets of these processors use -O3.
set(optimised -D CMAKE_BUILD_TYPE=Release -D "CMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG")

# Ends the case: what it needs is not there.
macro(skip why)
  message(FATAL_ERROR "Skipped: ${why}")
endmacro()

# run(command…): sets `output`, and ends the case if the command fails.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# fails(text command…): the command must fail and say the text.
function(fails text)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake wraps what it says
  string(FIND "${output}" "${text}" place)
  if(result EQUAL 0 OR place EQUAL -1)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result} and did not say \"${text}\":\n${output}")
  endif()
endfunction()

# needs(compiler [flag…]): skips the case unless the compiler is there and makes programs with those flags.
function(needs compiler)
  find_program(path_of_${compiler} ${compiler})
  if(NOT path_of_${compiler})
    skip("there is no ${compiler} on this machine")
  endif()
  file(WRITE ${WORK}/probe.cpp "#include <vector>\nint main() { return static_cast<int>(std::vector<int>().size()); }\n")
  execute_process(COMMAND ${compiler} ${ARGN} probe.cpp -o probe WORKING_DIRECTORY ${WORK}
    RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " flags)
    skip("${compiler} ${flags} makes no programs on this machine")
  endif()
endfunction()

# configure(compiler [option…]): the parent project, in a folder whose name has a space. Options go to cmake.
function(configure compiler)
  run(${CMAKE_COMMAND} --no-warn-unused-cli -S ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/parent -B "${WORK}/a parent"
    -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${compiler} -D SHAFTCULL=${SHAFTCULL} -D CLIENT=${client} ${ARGN})
  if(output MATCHES "CMake Warning[^\n]*\n[^\n]*\n[^\n]*\n")
    message(FATAL_ERROR "configuring warns:\n${CMAKE_MATCH_0}")
  endif()
  file(READ "${WORK}/a parent/compile_commands.json" commands)
  set(commands "${commands}" PARENT_SCOPE)
endfunction()

# configure_for_processor(cpu): likewise for another processor, which qemu emulates, with the program of hashes; without oneTBB.
# What is emulated takes fifty times as long, so such cases ask about hashes on the best instruction set only.
macro(configure_for_processor cpu)
  needs(${cpu}-linux-gnu-g++)
  find_program(qemu qemu-${cpu})
  if(NOT qemu)
    skip("there is no qemu-${cpu} on this machine")
  endif()
  set(emulator ${qemu})
  configure(${cpu}-linux-gnu-g++ -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=${cpu} -D CMAKE_EXE_LINKER_FLAGS=-static
    ${optimised} -D SHAFTCULL_WITH_TBB=OFF -D CMAKE_DISABLE_FIND_PACKAGE_xsimd=ON
    -D PARENT_MORE=${with_hashes})
endmacro()

# configure_with_libcxx(version): likewise by clang 19 with a libc++ that `./cmake/run test` has unpacked; not optimised.
macro(configure_with_libcxx version)
  needs(clang++-19)
  get_filename_component(libcxx ${BUILD}/../libcxx/${version}/usr/lib/llvm-${version} ABSOLUTE)
  if(NOT EXISTS ${libcxx}/lib/libc++.a)
    skip("${libcxx} has no libc++")
  endif()
  configure(clang++-19 -D "PARENT_OPTIONS=-O0 -nostdinc++ -nostdlib++ -isystem ${libcxx}/include/c++/v1"
    -D "CMAKE_CXX_STANDARD_LIBRARIES=${libcxx}/lib/libc++.a ${libcxx}/lib/libc++abi.a -pthread"
    -D SHAFTCULL_WITH_TBB=OFF)
endmacro()

# build(): builds what configure() made. The log must hold no warning.
function(build)
  run(${CMAKE_COMMAND} --build "${WORK}/a parent" --parallel 2)
  if(output MATCHES "[^\n]*warning[^\n]*")
    message(FATAL_ERROR "building warns:\n${output}")
  endif()
endfunction()

# answers([text]): the client's answers are those on record; what it prints, which `output` is set to, is `text`. Where it is for
# another processor, `emulator` runs it.
set(emulator "")
set(suffix "")
function(answers)
  run(${emulator} "${WORK}/a parent/client${suffix}")
  string(REPLACE "\r" "" output "${output}")
  set(output "${output}" PARENT_SCOPE)
  if(ARGN AND NOT output STREQUAL "${ARGN}")
    message(FATAL_ERROR "the client prints\n${output}instead of\n${ARGN}")
  endif()
endfunction()

# hashes(text [option…]): likewise of the program that parent/hashes.cmake builds, with these options.
function(hashes text)
  run(${emulator} "${WORK}/a parent/hashes${suffix}" ${ARGN})
  string(REPLACE "\r" "" output "${output}")
  set(output "${output}" PARENT_SCOPE)
  if(NOT output STREQUAL text)
    message(FATAL_ERROR "the hashes are\n${output}instead of\n${text}")
  endif()
endfunction()

# hashes_as_answered(): likewise, on the instruction sets that the client told of last.
function(hashes_as_answered)
  string(REPLACE ": as on" ": hashes as on" expected "${output}")
  hashes("${expected}")
endfunction()

# use_pkg_config(prefix): has pkg-config read the files that are installed there; skips the rest of the case where there is none.
macro(use_pkg_config prefix)
  find_program(pkg_config NAMES pkg-config pkgconf)
  if(NOT pkg_config)
    skip("there is no pkg-config on this machine; all else of the case is as it should be")
  endif()
  file(GLOB_RECURSE pc_file "${prefix}/*/shaftcull.pc")
  get_filename_component(pc_folder "${pc_file}" DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} "${pc_folder}")
endmacro()

# run_by_pkg_config(library compiler word…): compiles a program with the flags of pkg-config for this library, and runs it.
function(run_by_pkg_config library)
  run(${pkg_config} --cflags --libs ${library})
  separate_arguments(flags UNIX_COMMAND "${output}")
  run(${ARGN} -o ${WORK}/by_hand ${flags})
  run(${WORK}/by_hand)
  set(output "${output}" PARENT_SCOPE)
endfunction()

include(${SHAFTCULL}/cmake/machine.cmake)
