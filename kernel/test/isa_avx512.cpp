// xsimd gets a name of its own in this unit, so that none of its inline functions is shared with another one.
#define xsimd xsimd_avx512
#include "isa/table.hpp"
#include "simd/lanes.hpp"
#include "test/driver.hpp"

const shaftcull::kernel::Kernels shaftcull::kernel::avx512_kernels = kernels_for<Lanes<xsimd::avx512bw>>;
