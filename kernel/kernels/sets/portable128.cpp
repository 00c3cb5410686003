// SPDX-License-Identifier: MIT
#include "simd/portable128.hpp"
#include "kernels/table_of.hpp"

namespace shaftcull::kernel::portable128 {

extern const Kernels* const kernels;
constinit const Kernels* const kernels = &kernels_for<Floats>;

}  // namespace shaftcull::kernel::portable128
