// SPDX-License-Identifier: MIT
/// What the compiler may use in every function of this unit. Where that is a whole instruction set, because a parent
/// project has asked for -march=native, say, kernels of lesser ones are left out: they would not be those sets' any
/// more.
#pragma once

#if defined(__AVX2__) && defined(__FMA__) && defined(__BMI__) && defined(__BMI2__)
#define SHAFTCULL_COMPILED_FOR_AVX2
#if defined(__AVX512F__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && \
    defined(__AVX512VL__)
#define SHAFTCULL_COMPILED_FOR_AVX512
#endif
#endif
