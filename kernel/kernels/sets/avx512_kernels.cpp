// SPDX-License-Identifier: MIT
#include "kernels/table_of_set.hpp"
#include "simd/x86/avx512.hpp"

namespace shaftcull::kernel::avx512 {

extern const Kernels* const kernels;
constinit const Kernels* const kernels = &kernels_for<Floats, FormationFloats>;

}  // namespace shaftcull::kernel::avx512
