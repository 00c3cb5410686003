// SPDX-License-Identifier: MIT
#include "simd/arm/neon.hpp"
#include "kernels/table_of.hpp"

namespace shaftcull::kernel::neon {

extern const Kernels* const kernels;
constinit const Kernels* const kernels = &kernels_for<Floats>;

}  // namespace shaftcull::kernel::neon
