// SPDX-License-Identifier: MIT
#include "simd/scalar.hpp"
#include "kernels/table_of.hpp"

namespace shaftcull::kernel::scalar {

extern const Kernels* const kernels;
constinit const Kernels* const kernels = &kernels_for<Floats>;

}  // namespace shaftcull::kernel::scalar
