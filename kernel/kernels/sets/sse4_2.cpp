#include "simd/baseline.hpp"
#ifndef SHAFTCULL_COMPILED_FOR_AVX2
#include "kernels/built_sets.hpp"
#include "kernels/table_of.hpp"
#include "simd/x86/sse4_2.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::sse4_2_kernels = kernels_for<sse4_2::Floats>;
#endif
