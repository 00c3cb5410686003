#include "isa/table.hpp"
#include "simd/scalar.hpp"
#include "test/driver.hpp"

constinit const shaftcull::kernel::Kernels shaftcull::kernel::scalar_kernels = kernels_for<ScalarLanes>;
