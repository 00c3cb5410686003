#include "simd/baseline.hpp"
#ifndef SHAFTCULL_COMPILED_FOR_AVX512
#include "kernels/built_sets.hpp"
#include "kernels/table_of.hpp"
#include "simd/x86/avx2.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::avx2_kernels = kernels_for<avx2::Floats>;
#endif
