# SPDX-License-Identifier: MIT
# 64-bit Windows by mingw-w64 with -O2, in wine, as DLLs that export the interface and nothing else, with oneTBB off.
needs(x86_64-w64-mingw32-g++-posix)
find_program(wine NAMES wine64 wine PATHS /usr/lib/wine)
if(NOT wine)
  skip("there is no wine64 on this machine")
endif()
# xsimd by itself, as no include folder of this machine belongs in front of the compiler's own.
file(STRINGS ${BUILD}/CMakeCache.txt package REGEX "^xsimd_DIR:")
string(REGEX REPLACE "^[^=]*=" "" package "${package}")
string(REGEX REPLACE "/(lib|share)/.*" "" machine "${package}")
file(RELATIVE_PATH place ${machine} ${package})
file(COPY ${package}/ DESTINATION ${WORK}/prefix/${place})
file(COPY ${machine}/include/xsimd DESTINATION ${WORK}/prefix/include)
configure(x86_64-w64-mingw32-g++-posix -D CMAKE_SYSTEM_NAME=Windows -D CMAKE_SYSTEM_PROCESSOR=x86_64
  -D CMAKE_BUILD_TYPE=Release -D "CMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG" -D SHAFTCULL_WITH_TBB=OFF
  -D BUILD_SHARED_LIBS=ON -D SHAFTCULL_BUILD_C=ON
  -D xsimd_DIR=${WORK}/prefix/${place}
  -D PARENT_MORE=${with_hashes})
build()

# exported(LIBRARY PATTERN): names that a DLL exports match the pattern, and none is of what is below the interface.
function(exported library pattern)
  run(x86_64-w64-mingw32-objdump -p "${WORK}/a parent/third_party/shaftcull/${library}")
  string(REGEX REPLACE "^.*.Ordinal/Name Pointer. Table" "" output "${output}")
  string(REGEX MATCHALL "\n[\t ]+\\[ *[0-9]+\\][^\n]* [A-Za-z_][^\n]*" lines "${output}")
  list(LENGTH lines count)
  if(count LESS 80)
    message(FATAL_ERROR "${library} exports ${count} names:\n${output}")
  endif()
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^.* " "" name "${line}")
    if(NOT name MATCHES "${pattern}" OR name MATCHES "^_ZN?K?9shaftcull6kernel")
      message(FATAL_ERROR "${library} exports ${name}, which is not of the interface")
    endif()
  endforeach()
endfunction()
exported(kernel/libshaftcull.dll "^_Z.*9shaftcull")
exported(bindings/c/libshaftcull_c.dll "^shaftcull_")

# Where the DLLs are, the compiler's own among them. Wine keeps its files in a folder of its own.
set(path "Z:${WORK}/a parent/third_party/shaftcull/kernel")
foreach(runtime IN ITEMS libstdc++-6.dll libgcc_s_seh-1.dll libwinpthread-1.dll)
  run(x86_64-w64-mingw32-g++-posix -print-file-name=${runtime})
  string(STRIP "${output}" output)
  get_filename_component(folder "${output}" DIRECTORY)
  string(APPEND path ";Z:${folder}")
endforeach()
set(ENV{WINEPATH} "${path}")
set(ENV{WINEPREFIX} ${WORK}/wine)
set(ENV{WINEDEBUG} -all)
set(emulator ${wine})
set(suffix .exe)
run(${emulator} "${WORK}/a parent/client.exe")  # the first program that wine runs also tells of the folder
answers()
hashes_as_answered()
if(NOT output MATCHES "sse4_2: as on record")
  message(FATAL_ERROR "on Windows, no instruction set of x86 answers:\n${output}")
endif()
