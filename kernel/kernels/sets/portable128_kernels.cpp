// SPDX-License-Identifier: MIT
#include "kernels/table_of_set.hpp"
#include "simd/portable128.hpp"

namespace shaftcull::kernel::portable128 {

extern const Kernels* const kernels;
constinit const Kernels* const kernels = &kernels_for<Floats>;

}  // namespace shaftcull::kernel::portable128
