# SPDX-License-Identifier: MIT
# Instruction sets that do not exist are refused. So is what would make answers wrong and cannot be taken back, by every source that
# includes a header (architecture.cmake looks for that).
needs(g++)
foreach(sets IN ITEMS see4_2 "")
  fails("SHAFTCULL_INSTRUCTION_SETS is \"${sets}\"; it can be AUTO, BEST, ALL, or a list of: scalar, portable128, sse4_2,"
    ${CMAKE_COMMAND} -S ${SHAFTCULL} -B ${WORK}/refused -G ${GENERATOR} "-DSHAFTCULL_INSTRUCTION_SETS=${sets}")
endforeach()
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
