// SPDX-License-Identifier: MIT
#include "simd/baseline.hpp"
#ifndef SHAFTCULL_COMPILED_FOR_AVX512
#include "kernels/table_of_set.hpp"
#include "simd/x86/avx2.hpp"
#else
#include "kernels/kernel_table.hpp"
#endif

namespace shaftcull::kernel::avx2 {

extern const Kernels* const kernels;
#ifndef SHAFTCULL_COMPILED_FOR_AVX512
constinit const Kernels* const kernels = &kernels_for<Floats>;
#else
constinit const Kernels* const kernels = nullptr;
#endif

}  // namespace shaftcull::kernel::avx2
