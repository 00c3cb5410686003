// SPDX-License-Identifier: MIT
#include "kernels/table_of_set.hpp"
#include "simd/arm/neon.hpp"

namespace shaftcull::kernel::neon {

extern const Kernels* const kernels;
constinit const Kernels* const kernels = &kernels_for<Floats>;

}  // namespace shaftcull::kernel::neon
