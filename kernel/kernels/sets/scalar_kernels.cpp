// SPDX-License-Identifier: MIT
#include "kernels/table_of_set.hpp"
#include "simd/scalar.hpp"

namespace shaftcull::kernel::scalar {

extern const Kernels* const kernels;
constinit const Kernels* const kernels = &kernels_for<Floats>;

}  // namespace shaftcull::kernel::scalar
