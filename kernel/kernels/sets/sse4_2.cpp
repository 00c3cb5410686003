// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_sse4_2
#include "dispatch/baseline.hpp"
#ifndef SHAFTCULL_COMPILED_FOR_AVX2
#include "dispatch/built_sets.hpp"
#include "kernels/table_of.hpp"
#include "simd/shorts.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::sse4_2_kernels = kernels_for<Lanes<xsimd::sse4_2>>;
#endif
