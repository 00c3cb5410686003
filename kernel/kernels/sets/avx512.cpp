// Which instruction set this unit is for, to simd/lanes.hpp.
#define SHAFTCULL_UNIT_AVX2
#define SHAFTCULL_UNIT_AVX512

// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_avx512
#include "dispatch/built_sets.hpp"
#include "kernels/table_of.hpp"
#include "simd/shorts.hpp"

// Formation transposes eight lanes at a time and is a quarter faster on vectors of eight.
constinit const shaftcull::kernel::Kernels shaftcull::kernel::avx512_kernels =
    kernels_for<Lanes<xsimd::avx512bw>, Lanes<xsimd::fma3<xsimd::avx2>>>;
