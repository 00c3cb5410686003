// Which instruction set this unit is for, to simd/lanes.hpp.
#define SHAFTCULL_UNIT_AVX2

// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_avx2
#include "dispatch/baseline.hpp"
#ifndef SHAFTCULL_COMPILED_FOR_AVX512
#include "dispatch/built_sets.hpp"
#include "kernels/table_of.hpp"
#include "simd/shorts.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::avx2_kernels =
    kernels_for<Lanes<xsimd::fma3<xsimd::avx2>>>;
#endif
