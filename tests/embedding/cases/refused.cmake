# SPDX-License-Identifier: MIT
# What would make answers wrong and cannot be taken back is refused, by every source of the library.
needs(g++)
set(compile g++ -std=c++20 -I ${SHAFTCULL}/include -I ${SHAFTCULL}/kernel -E -o ${WORK}/out)
set(is_wrong "its answers would be wrong")
file(GLOB_RECURSE sources ${SHAFTCULL}/kernel/*.cpp)
foreach(source IN LISTS sources)
  # Of these some are as sets/scalar_kernels.cpp, with flags of their own; the others do not compute with floats.
  if(NOT source MATCHES "sets/(sse4_2|avx2|avx512|neon)_kernels.cpp$|(support/|visibility_)arguments.cpp$|support/processor.cpp$|compiled/answers.cpp$")
    fails("${is_wrong}" ${compile} -ffast-math ${source})
  endif()
endforeach()
set(header ${SHAFTCULL}/kernel/support/exact_floats.hpp)
foreach(part IN ITEMS "-Ofast" "-ffinite-math-only" "-freciprocal-math"
    "-fassociative-math -fno-signed-zeros -fno-trapping-math")
  separate_arguments(part)
  fails("${is_wrong}" ${compile} ${part} ${header})
endforeach()

needs(clang++-19)
fails("shaftcull is compiled by g++ or clang" clang++-19 --target=x86_64-pc-windows-msvc -std=c++20 -fsyntax-only -x c++
  ${SHAFTCULL}/kernel/support/compiler.hpp)

needs(g++ -m32)
set(compile g++ -std=c++20 -m32 -fsyntax-only -x c++)
fails("on 32-bit x86 compile with -msse2 -mfpmath=sse" ${compile} -mfpmath=387 ${header})
run(${compile} -msse2 -mfpmath=sse ${header})
