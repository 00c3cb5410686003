// SPDX-License-Identifier: MIT
/// Refuses to be compiled where the compiler may change what floating-point code computes: every answer of this library
/// is proven for IEEE 754 arithmetic, operation by operation (docs/exactness.md).
#pragma once

#include <cfloat>

// CMake appends flags that take back what a parent project may have asked for; these find what it could not.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "shaftcull cannot be compiled with -ffast-math, -Ofast or parts of them: its answers would be wrong"
#endif

static_assert(FLT_EVAL_METHOD == 0,
              "shaftcull needs floats that are computed as floats: on 32-bit x86 compile with -msse2 -mfpmath=sse");
