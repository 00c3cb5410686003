// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_sse4_2
#include "isa/baseline.hpp"
#ifndef SHAFTCULL_COMPILED_FOR_AVX2
#include "isa/table.hpp"
#include "simd/shorts.hpp"
#include "test/driver.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::sse4_2_kernels = kernels_for<Lanes<xsimd::sse4_2>>;
#endif
