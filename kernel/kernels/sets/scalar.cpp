#include "simd/scalar.hpp"
#include "kernels/built_sets.hpp"
#include "kernels/table_of.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::scalar_kernels = kernels_for<scalar::Floats>;
