# SPDX-License-Identifier: MIT
# What would make answers wrong and cannot be taken back is refused, by every source that includes a header (architecture.cmake looks
# for that).
needs(g++)
set(compile g++ -std=c++20 -I ${SHAFTCULL}/include -I ${SHAFTCULL}/kernel -E -o ${WORK}/out)
set(is_wrong "its answers would be wrong")
fails("${is_wrong}" ${compile} -ffast-math ${SHAFTCULL}/kernel/tree/tree_query.cpp)
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
